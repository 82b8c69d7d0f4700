// SPDX-License-Identifier: GPL-3.0-or-later
// The clock that curves and pictures share. It has a current moment on its axis, which is strain, a fraction of the
// strain at peak, time or the frame's number. Each test shows its last frame at or before that moment.

import {peakOf, type TestData} from '../data/report';
import {quantity, significant, strain} from '../quantities/units';

export type Axis = 'strain' | 'share' | 'time' | 'frame';

export const axisNames: Record<Axis, string> = {strain: 'Strain', share: 'Fraction of peak strain', time: 'Time', frame: 'Frame'};

const framesPerSecond = 15; // at speed 1

/// Axes for which all tests have values.
export function axesFor(tests: readonly TestData[]): Axis[] {
    const curved = tests.every((test) => test.curve && test.frames.every((frame) => frame.axial_strain !== undefined));
    const peaked = curved && tests.every((test) => (peakOf(test).strain ?? 0) > 0);
    return [...(curved ? ['strain' as const] : []), ...(peaked ? ['share' as const] : []), 'time', 'frame'];
}

/// Positions of a test's frames on an axis, in ascending order.
export function momentsOf(test: TestData, axis: Axis): number[] {
    let latest = -Infinity;
    return test.frames.map((frame, index) => {
        const strain = frame.axial_strain ?? 0;
        const value = axis === 'frame' ? index : axis === 'time' ? frame.time : axis === 'strain' ? strain : strain / (peakOf(test).strain ?? 1);
        return latest = Math.max(latest, value);
    });
}

/// Position on `axis` of the test's frame that is nearest to a strain or time.
export function momentNear(test: TestData, axis: Axis, other: 'strain' | 'time', value: number): number {
    const values = momentsOf(test, other), before = lastAtOrBefore(values, value), after = Math.min(values.length - 1, before + 1);
    const nearest = Math.abs(values[after]! - value) < Math.abs(values[before]! - value) ? after : before;
    return momentsOf(test, axis)[nearest]!;
}

export class Clock {
    axis: Axis = 'frame';
    speed = 1;
    held = false; // whether playing waits, because a frame is being unpacked
    onTick: () => void = () => {};
    private moments: number[] = [0]; // positions of all tests' frames on the axis
    private perTest = new Map<TestData, number[]>();
    private at = 0; // index into moments
    private value = 0; // position on the axis; while playing, it may lie between moments
    private last = 0; // ms, time of the last tick while playing
    private running = 0;

    setTests(tests: readonly TestData[], axis: Axis): void {
        const share = this.moments.length > 1 ? this.at / (this.moments.length - 1) : 0;
        const kept = axis === this.axis ? this.moment : undefined;
        this.axis = axis;
        this.perTest = new Map(tests.map((test) => [test, momentsOf(test, axis)]));
        this.moments = [...new Set([...this.perTest.values()].flat())].sort((a, b) => a - b);
        this.go(kept === undefined ? Math.round(share * (this.moments.length - 1)) : this.indexOf(kept));
    }

    get count(): number {
        return this.moments.length;
    }

    get index(): number {
        return this.at;
    }

    get moment(): number {
        return this.moments[this.at] ?? 0;
    }

    get end(): number {
        return this.moments[this.moments.length - 1] ?? 0;
    }

    get playing(): boolean {
        return this.running !== 0;
    }

    /// The frame that a test shows at the current moment.
    frameOf(test: TestData): number {
        const moments = this.perTest.get(test) ?? momentsOf(test, this.axis);
        return lastAtOrBefore(moments, this.moment);
    }

    go(index: number): void {
        this.at = Math.min(this.moments.length - 1, Math.max(0, index));
        this.value = this.moment;
        this.onTick();
    }

    goTo(moment: number): void {
        this.go(this.nearest(moment));
    }

    step(by: number): void {
        this.pause();
        this.go(this.at + by);
    }

    play(): void {
        if (this.playing || this.moments.length < 2) return;
        if (this.at === this.moments.length - 1) this.go(0);
        this.last = performance.now();
        this.running = requestAnimationFrame((now) => this.advance(now));
        this.onTick();
    }

    pause(): void {
        if (!this.playing) return;
        cancelAnimationFrame(this.running);
        this.running = 0;
        this.onTick();
    }

    private advance(now: number): void {
        this.running = requestAnimationFrame((next) => this.advance(next));
        const longest = Math.max(...[...this.perTest.values()].map((moments) => moments.length));
        const first = this.moments[0]!;
        if (!this.held) this.value += (this.end - first) * Math.max(0, now - this.last) / 1000 * this.speed * framesPerSecond / Math.max(1, longest - 1);
        this.last = now;
        const index = this.indexOf(this.value);
        if (index === this.at) return;
        this.at = index;
        if (index === this.moments.length - 1) this.pause();
        else this.onTick();
    }

    private indexOf(value: number): number {
        return lastAtOrBefore(this.moments, value);
    }

    private nearest(value: number): number {
        const before = this.indexOf(value), after = Math.min(this.moments.length - 1, before + 1);
        return Math.abs(this.moments[after]! - value) < Math.abs(this.moments[before]! - value) ? after : before;
    }
}

/// The clock's moment as text, if several tests are shown. The moment of each test is printed over its pane.
export function clockText({axis, moment}: Clock): string {
    switch (axis) {
        case 'strain': return `ε = ${strain(moment)}`;
        case 'share': return `ε = ${significant(moment)} of the strain at peak`;
        case 'time': return `t = ${quantity(moment, 's')}`;
        case 'frame': return `Frame ${moment + 1}`;
    }
}

function lastAtOrBefore(moments: readonly number[], value: number): number {
    let low = 0, high = moments.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (moments[middle]! <= value) low = middle;
        else high = middle - 1;
    }
    return low;
}
