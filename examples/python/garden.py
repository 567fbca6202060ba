# SPDX-License-Identifier: BSD-3-Clause
"""A light field, its depth and what can be made of it, in cells as of a notebook.

    python3 garden.py [OUT]
"""

# %% A rendered row of views with exact truth, in place of your own pictures
import pathlib
import sys

import matplotlib
import numpy as np

import gigaray as gg

matplotlib.use("Agg")  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "garden_out")
folder.mkdir(exist_ok=True)
lf = gg.synth("garden", views=(9, 1), size=(176, 120))
print(lf)

# %% The same from arrays: (view, v, u, 3) and where the views stand
pixels = np.stack(list(lf))
row = gg.LightField(pixels, s=np.arange(-4, 5), **lf.rig)

# %% Depth of every view
with gg.progress():
    out = gg.reconstruct(row, disparity=(-1.2, 1.2))
scores = gg.evaluate(out, lf)
print(f"{out}: {scores['BadPix0.07']:.1f} % of the pixels are off by more than 0.07 px")

# %% A picture, its disparity, a row of all views, and what is near
figure, axes = plt.subplots(2, 2, figsize=(9, 6), layout="constrained")
axes[0, 0].imshow(out.top.picture)
axes[0, 1].imshow(out.disparity, cmap=gg.colours())
axes[1, 0].imshow(lf.epi(v=60), aspect="auto")
axes[1, 1].imshow(out.mask(near=1.2, far=0.2), cmap="gray")
for axis, title in zip(axes.flat, ["view", "disparity", "row 60 of all views", "near"]):
    axis.set_title(title)
    axis.set_axis_off()
figure.savefig(folder / "garden.png")

# %% Between two views; a surface for Blender
plt.imsave(folder / "between.png", out.render((0.5, 0)))
if gg.config()["meshing"]:
    mesh = out.mesh(method="grid")
    mesh.save(folder / "garden.glb")
    print(mesh)
