// SPDX-License-Identifier: GPL-3.0-or-later
// Type declarations for the functions of gifenc that are used, since the package has none.
declare module 'gifenc' {
    type Palette = number[][];
    interface Encoder {
        writeFrame(indices: Uint8Array, width: number, height: number, options: {palette: Palette; delay: number}): void;
        finish(): void;
        bytes(): Uint8Array<ArrayBuffer>;
    }
    export function GIFEncoder(): Encoder;
    export function quantize(rgba: Uint8ClampedArray, colours: number): Palette;
    export function applyPalette(rgba: Uint8ClampedArray, palette: Palette): Uint8Array;
}
