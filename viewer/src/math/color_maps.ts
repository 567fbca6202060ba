// SPDX-License-Identifier: BSD-3-Clause
// Colour maps as 256 RGBA entries for a texture and for legends.

export type ColorMapName = "turbo" | "viridis" | "signed" | "levels";

const SIZE = 256;

// Polynomials over 0 … 1 from the lowest power up: turbo (Google, Apache-2.0 / public coefficients)
// and viridis (fitted to matplotlib's public-domain table).
const TURBO = [
  [0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943],
  [0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604],
  [0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973],
];
const VIRIDIS = [
  [0.27772733, 0.10509304, -0.33086183, -4.63423049, 6.22826999, 4.77638482, -5.43545589],
  [0.00540734, 1.40461353, 0.21484756, -5.79910084, 14.17993337, -13.74514538, 4.64585261],
  [0.33409981, 1.38459014, 0.09509516, -19.33244096, 56.69055267, -65.35303263, 26.31243525],
];
const LEVELS = [0x4e79a7, 0xf28e2b, 0x59a14f, 0xe15759, 0x76b7b2, 0xedc948, 0xb07aa1, 0x9c755f];

/** 256 RGBA entries, sRGB. */
export function colorMap(name: ColorMapName): Uint8Array<ArrayBuffer> {
  const rgba = new Uint8Array(4 * SIZE);
  for (let i = 0; i < SIZE; i++) {
    const color = entry(name, i);
    for (let c = 0; c < 3; c++) {
      rgba[4 * i + c] = Math.round(255 * Math.min(1, Math.max(0, color[c]!)));
    }
    rgba[4 * i + 3] = 255;
  }
  return rgba;
}

function entry(name: ColorMapName, idx: number): number[] {
  const x = idx / (SIZE - 1);
  switch (name) {
    case "turbo":
      // Without its darkest ends, which look like shadow.
      return TURBO.map((powers) => polynomial(powers, 0.05 + 0.89 * x));
    case "viridis":
      return VIRIDIS.map((powers) => polynomial(powers, x));
    case "signed": {
      // Blue below zero, grey at zero, red above.
      const y = 2 * x - 1;
      const grey = 0.86 * (1 - Math.abs(y));
      return y < 0
        ? [grey, grey - 0.35 * y, grey - 0.85 * y]
        : [grey + 0.85 * y, grey + 0.2 * y, grey];
    }
    case "levels": {
      const color = LEVELS[idx % LEVELS.length]!;
      return [color >> 16, (color >> 8) & 255, color & 255].map((value) => value / 255);
    }
  }
}

function polynomial(powers: number[], x: number): number {
  return powers.reduceRight((sum, factor) => sum * x + factor, 0);
}

/** A CSS gradient of the map, from its first entry on the left to its last one. */
export function cssGradient(rgba: Uint8Array): string {
  const stops: string[] = [];
  for (let i = 0; i < SIZE; i += 17) {
    stops.push(`rgb(${rgba[4 * i]} ${rgba[4 * i + 1]} ${rgba[4 * i + 2]})`);
  }
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
