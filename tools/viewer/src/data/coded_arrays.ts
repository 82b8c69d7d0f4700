// SPDX-License-Identifier: GPL-3.0-or-later
// Coded arrays (tools/page/page_data.hpp). An integer n means the value quantum · n, or with a growth g the value
// quantum / g · sinh(g · n), so that small and large values have about the same relative resolution. Tables store differences
// between rows in zigzag code, one plane of bytes after another, the lowest bytes first. Slowly changing values give planes of
// zeros, which zlib compresses to almost nothing.

export interface CodedEntry {
    quantum: number;
    growth?: number;
    offset: number; // bytes from the start of the block
    planes: number;
    rows: number;
    columns: number;
}

/// Decodes zigzag code: 0, 1, 2, 3 … mean 0, −1, 1, −2 …
const difference = (u: number): number => (u % 2 === 0 ? u / 2 : -(u + 1) / 2);

const valueOf = ({quantum, growth}: CodedEntry, n: number): number => (growth ? quantum / growth * Math.sinh(growth * n) : quantum * n);

/// Spacing of representable values near a value.
export const resolutionAt = ({quantum, growth}: CodedEntry, value: number): number => Math.hypot(quantum, (growth ?? 0) * value);

/// A version of valueOf() that remembers its results, since computing every sinh would double the time for decoding.
function valuesBy(entry: CodedEntry): (n: number) => number {
    if (!entry.growth) return (n) => entry.quantum * n;
    const known: number[] = []; // values for n = 0, 1, 2 …, at most some thousands
    return (n) => {
        const value = known[Math.abs(n)] ??= valueOf(entry, Math.abs(n));
        return n < 0 ? -value : value;
    };
}

function coded(bytes: Uint8Array, entry: CodedEntry, at: number): number {
    const plane = entry.rows * entry.columns;
    let u = 0;
    for (let p = entry.planes - 1; p >= 0; --p) u = 256 * u + bytes[entry.offset + p * plane + at]!;
    return u;
}

function checked(bytes: Uint8Array, entry: CodedEntry): void {
    if (entry.offset + entry.planes * entry.rows * entry.columns > bytes.length) throw new Error('a coded array extends beyond its block');
}

/// All values, row by row.
export function decode(bytes: Uint8Array, entry: CodedEntry): Float32Array {
    checked(bytes, entry);
    const {rows, columns, planes} = entry, valueAt = valuesBy(entry);
    const size = rows * columns, values = new Float32Array(size);
    if (planes === 0) return values;
    const sums = new Float64Array(columns);
    const low = entry.offset, high = low + size;
    for (let row = 0, at = 0; row < rows; ++row) {
        for (let column = 0; column < columns; ++column, ++at) {
            // Nearly all arrays have one or two planes.
            const u = planes === 1 ? bytes[low + at]! : planes === 2 ? bytes[low + at]! + 256 * bytes[high + at]! : coded(bytes, entry, at);
            values[at] = valueAt(sums[column]! += difference(u));
        }
    }
    return values;
}

/// The values of one column.
export function decodeColumn(bytes: Uint8Array, entry: CodedEntry, column: number): Float32Array {
    checked(bytes, entry);
    let sum = 0;
    return Float32Array.from({length: entry.rows}, (_, row) => valueOf(entry, sum += difference(coded(bytes, entry, row * entry.columns + column))));
}

/// The values of a list, a single row stored as differences between columns.
export function decodeList(bytes: Uint8Array, entry: CodedEntry): Float32Array {
    checked(bytes, entry);
    let sum = 0;
    return Float32Array.from({length: entry.columns}, (_, at) => valueOf(entry, sum += difference(coded(bytes, entry, at))));
}
