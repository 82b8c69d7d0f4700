// SPDX-License-Identifier: GPL-3.0-or-later
// The frames of one test. They are stored in groups of one block each. A group is unpacked when one of its frames is needed,
// and the next group soon after; a few groups are kept. Arrays of a group are decoded when first used.

import {readBlock} from './blocks';
import {decode, decodeColumn, decodeList, resolutionAt} from './coded_arrays';
import type {FrameEntry, GroupEntry, TestData} from './report';

const groupsKept = 3;

/// Contacts that are not bonds.
export interface Contacts {
    count: number;
    i: Float32Array; // cells
    j: Float32Array; // cells, or walls: -1 left, -2 right, -3 bottom, -4 top
    x: Float32Array; // m
    y: Float32Array;
    fn: Float32Array; // N, compression positive
    fs: Float32Array;
}

class Group {
    private readonly bytes: Uint8Array;
    private readonly decoded = new Map<string, Float32Array>();

    constructor(readonly entry: GroupEntry, block: ArrayBuffer) {
        this.bytes = new Uint8Array(block);
    }

    row(name: string, row: number): Float32Array | undefined {
        const entry = this.entry.arrays[name];
        if (!entry) return undefined;
        let values = this.decoded.get(name);
        if (!values) this.decoded.set(name, values = decode(this.bytes, entry));
        return values.subarray(row * entry.columns, (row + 1) * entry.columns);
    }

    column(name: string, column: number): Float32Array | undefined {
        const entry = this.entry.arrays[name];
        return entry && decodeColumn(this.bytes, entry, column);
    }

    contacts(row: number): Contacts {
        const counts = this.list('contacts.count');
        let first = 0;
        for (let before = 0; before < row; ++before) first += counts[before] ?? 0;
        const count = counts[row] ?? 0;
        const part = (name: string) => this.list(`contacts.${name}`).subarray(first, first + count);
        return {count, i: part('i'), j: part('j'), x: part('x'), y: part('y'), fn: part('fn'), fs: part('fs')};
    }

    private list(name: string): Float32Array {
        let values = this.decoded.get(name);
        const entry = this.entry.arrays[name];
        if (!values) this.decoded.set(name, values = entry ? decodeList(this.bytes, entry) : new Float32Array(0));
        return values;
    }
}

/// One moment of a test. Displacements and angles are relative to the first frame.
export class Frame {
    readonly time: number; // s
    readonly strain: number | undefined;
    readonly ux: Float32Array; // m
    readonly uy: Float32Array;
    readonly angle: Float32Array; // rad, counter-clockwise

    constructor(readonly index: number, readonly entry: FrameEntry, cellCount: number, private readonly group: Group | undefined) {
        this.time = entry.time;
        this.strain = entry.axial_strain;
        const still = new Float32Array(group ? 0 : cellCount);
        this.ux = this.field('ux') ?? still;
        this.uy = this.field('uy') ?? still;
        this.angle = this.field('angle') ?? still;
    }

    /// An array of the frame by its name in the page's data; undefined if it was not written.
    field(name: string): Float32Array | undefined {
        return this.group?.row(name, this.index - this.group.entry.first);
    }

    /// Resolution of an array's values near this value.
    resolution(name: string, value: number): number {
        const entry = this.group?.entry.arrays[name];
        return entry ? resolutionAt(entry, value) : 0;
    }

    get contacts(): Contacts | undefined {
        return this.group?.contacts(this.index - this.group.entry.first);
    }
}

export class Frames {
    readonly count: number;
    private readonly groups = new Map<GroupEntry, Group>(); // ordered by last use
    private readonly loading = new Map<GroupEntry, Promise<Group>>();

    constructor(private readonly test: TestData) {
        this.count = test.frames.length;
    }

    /// Whether the frames contain this array.
    has(name: string): boolean {
        return this.test.groups.some((group) => name in group.arrays);
    }

    /// The frame; undefined if its group is not unpacked.
    ready(index: number): Frame | undefined {
        const entry = this.entryOf(index);
        const group = entry && this.groups.get(entry);
        if (entry && !group) return undefined;
        if (entry && group) this.keep(entry, group);
        return this.frame(index, group);
    }

    async load(index: number): Promise<Frame> {
        const entry = this.entryOf(index);
        return this.frame(index, entry && await this.unpack(entry));
    }

    /// The first frame. It is available before its block is loaded, since nothing has moved in it.
    first(): Frame {
        return this.frame(0, undefined);
    }

    /// Unpacks the next group in advance, for playing.
    prefetch(index: number): void {
        const entry = this.entryOf(index);
        const next = entry && this.entryOf(entry.first + entry.count);
        if (next && !this.groups.has(next)) void this.unpack(next);
    }

    /// Values of a cell or bond (a column) in all frames.
    async history(names: readonly string[], column: number): Promise<Map<string, Float32Array>> {
        const histories = new Map<string, Float32Array>();
        for (const entry of this.test.groups) {
            const group = this.groups.get(entry) ?? new Group(entry, await readBlock(this.test.index, entry.block));
            for (const name of names) {
                const part = group.column(name, column);
                if (!part) continue;
                if (!histories.has(name)) histories.set(name, new Float32Array(this.count).fill(NaN));
                histories.get(name)!.set(part, entry.first);
            }
        }
        return histories;
    }

    /// Yields every `stride`-th frame without changing the groups kept for playing.
    async* pass(stride: number): AsyncGenerator<Frame> {
        for (const entry of this.test.groups) {
            const group = this.groups.get(entry) ?? new Group(entry, await readBlock(this.test.index, entry.block));
            for (let index = Math.ceil(entry.first / stride) * stride; index < entry.first + entry.count; index += stride) yield this.frame(index, group);
            await new Promise((resume) => setTimeout(resume)); // keeps the page responsive
        }
    }

    private frame(index: number, group: Group | undefined): Frame {
        return new Frame(index, this.test.frames[index]!, this.test.cells.count, group);
    }

    private entryOf(index: number): GroupEntry | undefined {
        return this.test.groups.find((group) => index >= group.first && index < group.first + group.count);
    }

    private async unpack(entry: GroupEntry): Promise<Group> {
        const kept = this.groups.get(entry);
        if (kept) return kept;
        let loading = this.loading.get(entry);
        if (!loading) {
            loading = readBlock(this.test.index, entry.block).then((block) => new Group(entry, block));
            this.loading.set(entry, loading);
            void loading.then((group) => this.keep(entry, group)).finally(() => this.loading.delete(entry));
        }
        return loading;
    }

    private keep(entry: GroupEntry, group: Group): void {
        this.groups.delete(entry);
        this.groups.set(entry, group);
        for (const oldest of this.groups.keys()) {
            if (this.groups.size <= groupsKept) break;
            this.groups.delete(oldest);
        }
    }
}
