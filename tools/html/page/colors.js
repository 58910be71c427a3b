// Colours of values and of sets.

/** From the worst to the best: ColorBrewer's Spectral, which the colour-blind can read too. */
const SPECTRAL = [[158, 1, 66], [213, 62, 79], [244, 109, 67], [253, 174, 97], [254, 224, 139], [230, 245, 152],
                  [171, 221, 164], [102, 194, 165], [50, 136, 189], [94, 79, 162]];
const SETS = [0x4e79a7, 0xf28e2b, 0x59a14f, 0xe15759, 0x76b7b2, 0xedc948, 0xb07aa1, 0xff9da7, 0x9c755f, 0x8c8c94];
export const NO_SET = [150, 155, 165];

/** 0 is the best, 1 and more the worst. */
export function badnessColor(badness) {
  const place = (1 - Math.min(1, badness)) * (SPECTRAL.length - 1);
  const i = Math.min(Math.floor(place), SPECTRAL.length - 2);
  return SPECTRAL[i].map((c, k) => Math.round(c + (place - i) * (SPECTRAL[i + 1][k] - c)));
}

export function setColor(i) {
  const color = SETS[i % SETS.length];
  // Each time round, the colours come lighter and then darker than the first time.
  const round = Math.floor(i / SETS.length);
  const part = 1 - 1 / (1 + 0.4 * Math.floor((round + 1) / 2));
  const towards = round % 2 === 1 ? 255 : 0;
  return [color >> 16, color >> 8 & 255, color & 255].map((c) => Math.round(c + part * (towards - c)));
}

export function css([r, g, b]) {
  return `rgb(${r},${g},${b})`;
}
