// SPDX-License-Identifier: GPL-3.0-or-later
// Plain arrays of a block: consecutive little-endian numbers.

export type NumberArray = Float64Array | Float32Array | Int32Array | Uint8Array;

export interface ArrayEntry {
    type: 'f64' | 'f32' | 'i32' | 'u8';
    offset: number; // bytes from the start of the block
    length: number; // number of elements
}

const bytesPerElement = {f64: 8, f32: 4, i32: 4, u8: 1} as const;

/// The array as a view of its block. @param name  name of the array for the error message if the block is too short
export function plainArray(buffer: ArrayBuffer, name: string, entry: ArrayEntry): NumberArray {
    if (entry.offset + entry.length * bytesPerElement[entry.type] > buffer.byteLength) {
        throw new Error(`the page's array '${name}' extends beyond its block`);
    }
    switch (entry.type) {
        case 'f64': return new Float64Array(buffer, entry.offset, entry.length);
        case 'f32': return new Float32Array(buffer, entry.offset, entry.length);
        case 'i32': return new Int32Array(buffer, entry.offset, entry.length);
        case 'u8': return new Uint8Array(buffer, entry.offset, entry.length);
    }
}
