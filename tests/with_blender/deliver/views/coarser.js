// Of the pages beside this file, each of which shows an engine what the scene's camera sees and has it as numbers:
// window.seen(width, height, flat) is RGB of each pixel, rows from the bottom.

// Rays along a pixel's side.
export const FINER = 4;

// RGB of each pixel: the mean of FINER x FINER RGBA values, in the same order of rows.
export function coarser(fine, width, height) {
  const pixels = new Array(3 * width * height).fill(0), columns = FINER * width;
  for (let y = 0; y < FINER * height; y++) for (let x = 0; x < columns; x++) for (let c = 0; c < 3; c++)
    pixels[3 * (Math.floor(y / FINER) * width + Math.floor(x / FINER)) + c] += fine[4 * (y * columns + x) + c] / FINER ** 2;
  return pixels;
}
