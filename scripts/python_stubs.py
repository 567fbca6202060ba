# SPDX-License-Identifier: BSD-3-Clause
"""Writes the types of the extension, _gigaray.pyi, into a folder (stubgen of mypy).

    PYTHONPATH=build/dev/python python3 scripts/python_stubs.py python/gigaray
"""

import pathlib
import re
import sys
import tempfile

from mypy import stubgen

HEAD = """# SPDX-License-Identifier: BSD-3-Clause
# Written by scripts/python_stubs.py.
"""


def stubs() -> str:
    with tempfile.TemporaryDirectory() as folder:
        stubgen.main(["-q", "-m", "gigaray._gigaray", "-o", folder])
        text = (pathlib.Path(folder) / "gigaray" / "_gigaray.pyi").read_text()
    text = re.sub(r"numpy\.ndarray\[(numpy\.\w+|bool)\]", r"numpy.typing.NDArray[\1]", text)
    text = re.sub(r"numpy\.ndarray\b", "numpy.typing.NDArray[Any]", text)
    text = text.replace("NDArray[bool]", "NDArray[numpy.bool_]")
    text = re.sub(r"\bos\.PathLike\b", "Union[str, os.PathLike[str]]", text)
    text = re.sub(r"^from typing import .*", "from typing import Any, Dict, List, Optional, Tuple, Union",
                  text, count=1, flags=re.MULTILINE)
    # An object of pybind11 is any.
    text = re.sub(r"(: |-> )object\b", r"\1Any", text)
    return HEAD + text.replace("import numpy\n", "import numpy\nimport numpy.typing\n")


if __name__ == "__main__":
    (pathlib.Path(sys.argv[1]) / "_gigaray.pyi").write_text(stubs())
