// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where broken bonds are drawn: on the two faces that the bond held together. Each face moves with its body, so that an
// open crack shows both sides. Faces are found once, in the first frame, in which the bodies still touch.
//   circle on any body    a short tangent to the circle at the contact, and a parallel line on the other body
//   other bodies          the parts of the two nearest parallel edges that face each other; where none do (corner on
//                         corner), short ticks across the line between the nearest points of the two outlines

import {centre, outline, reach, type Cells, type Point} from '../data/cells';
import type {Events} from '../data/report';

type Segment = [Point, Point];

/// One side of a broken interface, a line that moves with its body.
export interface CrackFace {
    cell: number;
    from: Point; // m, first frame
    to: Point;
}

/// All breaks of one pair of bodies.
export interface Crack {
    faces: CrackFace[];
    breaks: {time: number; shear: boolean; last: boolean}[];
}

const minus = (a: Point, b: Point): Point => ({x: a.x - b.x, y: a.y - b.y});
const along = (a: Point, direction: Point, by: number): Point => ({x: a.x + direction.x * by, y: a.y + direction.y * by});
const dot = (a: Point, b: Point): number => a.x * b.x + a.y * b.y;
const cross = (a: Point, b: Point): number => a.x * b.y - a.y * b.x;
const unit = (a: Point): Point => {
    const size = Math.hypot(a.x, a.y);
    return size > 0 ? {x: a.x / size, y: a.y / size} : {x: 1, y: 0};
};

function edges(cells: Cells, cell: number): Segment[] {
    const points = outline(cells, cell);
    const joined: Segment[] = points.slice(1).map((point, index) => [points[index]!, point]);
    if (cells.open[cell] !== 1 && points.length > 2) joined.push([points[points.length - 1]!, points[0]!]);
    return joined;
}

function nearestOn([a, b]: Segment, point: Point): Point {
    const direction = minus(b, a);
    const share = dot(minus(point, a), direction) / Math.max(dot(direction, direction), Number.MIN_VALUE);
    return along(a, direction, Math.min(1, Math.max(0, share)));
}

const tick = (cell: number, at: Point, normal: Point, half: number): CrackFace => {
    const tangent = {x: -normal.y, y: normal.x};
    return {cell, from: along(at, tangent, -half), to: along(at, tangent, half)};
};

function circleFaces(cells: Cells, circle: number, other: number): CrackFace[] {
    const from = centre(cells, circle);
    const radius = cells.radius[circle]!;
    if (cells.radius[other]! > 0) {
        const to = centre(cells, other);
        const normal = unit(minus(to, from));
        const half = 0.6 * Math.min(radius, cells.radius[other]!);
        return [tick(circle, along(from, normal, radius), normal, half), tick(other, along(to, normal, -cells.radius[other]!), normal, half)];
    }
    const candidates = edges(cells, other).map((edge) => nearestOn(edge, from));
    const nearest = candidates.reduce((best, point) =>
        (Math.hypot(point.x - from.x, point.y - from.y) < Math.hypot(best.x - from.x, best.y - from.y) ? point : best));
    const normal = unit(minus(nearest, from));
    return [tick(circle, along(from, normal, radius), normal, 0.6 * radius), tick(other, nearest, normal, 0.6 * radius)];
}

/// The overlapping parts of two nearly parallel edges, and the distance between them.
function facing(a: Segment, b: Segment): {first: Segment; second: Segment; length: number; gap: number} | undefined {
    const tangent = unit(minus(a[1], a[0]));
    if (Math.abs(cross(tangent, unit(minus(b[1], b[0])))) > 0.2) return undefined;
    const [b1, b2] = [dot(minus(b[0], a[0]), tangent), dot(minus(b[1], a[0]), tangent)];
    const low = Math.max(0, Math.min(b1, b2));
    const high = Math.min(dot(minus(a[1], a[0]), tangent), Math.max(b1, b2));
    if (high <= low) return undefined;
    const first: Segment = [along(a[0], tangent, low), along(a[0], tangent, high)];
    const second: Segment = [nearestOn(b, first[0]), nearestOn(b, first[1])];
    const gap = Math.max(Math.hypot(second[0].x - first[0].x, second[0].y - first[0].y), Math.hypot(second[1].x - first[1].x, second[1].y - first[1].y));
    return {first, second, length: high - low, gap};
}

function outlineFaces(cells: Cells, i: number, j: number): CrackFace[] {
    let best: ReturnType<typeof facing>;
    for (const a of edges(cells, i)) {
        for (const b of edges(cells, j)) {
            const found = facing(a, b);
            // A wide gap counts more than a long overlap, so that edges on the far sides are not chosen.
            if (found && found.gap < found.length && (!best || found.length - 4 * found.gap > best.length - 4 * best.gap)) best = found;
        }
    }
    if (best) return [{cell: i, from: best.first[0], to: best.first[1]}, {cell: j, from: best.second[0], to: best.second[1]}];

    let nearest: {a: Point; b: Point; distance: number} | undefined;
    const consider = (a: Point, b: Point) => {
        const distance = Math.hypot(a.x - b.x, a.y - b.y);
        if (!nearest || distance < nearest.distance) nearest = {a, b, distance};
    };
    for (const corner of outline(cells, i)) for (const edge of edges(cells, j)) consider(corner, nearestOn(edge, corner));
    for (const corner of outline(cells, j)) for (const edge of edges(cells, i)) consider(nearestOn(edge, corner), corner);
    if (!nearest) return [];
    const normal = unit(minus(nearest.b, nearest.a));
    const half = Math.max(2 * nearest.distance, 0.1 * Math.min(reach(cells, i), reach(cells, j)));
    return [tick(i, nearest.a, normal, half), tick(j, nearest.b, normal, half)];
}

/// The two faces of the interface of two cells.
export function facesOf(cells: Cells, i: number, j: number): CrackFace[] {
    if (cells.radius[i]! > 0) return circleFaces(cells, i, j);
    if (cells.radius[j]! > 0) return circleFaces(cells, j, i);
    return outlineFaces(cells, i, j);
}

/// Approximate distance between the surfaces of two cells. It is used to find which circles of two clumps touched.
function gap(cells: Cells, i: number, j: number): number {
    const a = centre(cells, i), b = centre(cells, j);
    return Math.hypot(a.x - b.x, a.y - b.y) - cells.radius[i]! - cells.radius[j]!;
}

/// Returns one crack per pair of bodies, ordered by their first breaks.
export function findCracks(cells: Cells, events: Events): Crack[] {
    const elementsOf = new Map<number, number[]>(); // cells by body id; a clump has several
    for (let element = 0; element < cells.count; ++element) {
        const id = cells.id[element]!, elements = elementsOf.get(id);
        if (elements) elements.push(element);
        else elementsOf.set(id, [element]);
    }
    const cracks = new Map<string, Crack>();
    for (let event = 0; event < events.count; ++event) {
        const ids = [events.bodyI[event]!, events.bodyJ[event]!] as const;
        const key = ids[0] < ids[1] ? `${ids[0]} ${ids[1]}` : `${ids[1]} ${ids[0]}`;
        let crack = cracks.get(key);
        if (!crack) {
            const pairs = (elementsOf.get(ids[0]) ?? []).flatMap((i) => (elementsOf.get(ids[1]) ?? []).map((j) => ({i, j, gap: gap(cells, i, j)})));
            if (pairs.length === 0) throw new Error(`break ${event + 1}: body ${ids[0]} or ${ids[1]} is not drawn`);
            const {i, j} = pairs.reduce((best, pair) => (pair.gap < best.gap ? pair : best));
            crack = {faces: facesOf(cells, i, j), breaks: []};
            cracks.set(key, crack);
        }
        crack.breaks.push({time: events.time[event]!, shear: events.shear[event] === 1, last: events.last[event] === 1});
    }
    return [...cracks.values()];
}

/// State of one crack at a time; undefined before its first break.
export interface CrackState {
    shear: boolean; // whether most of its breaks were in shear mode
    parted: boolean; // whether all bonded points of the interface are broken
    since: number; // s, time of the first break
}

export function crackState(crack: Crack, time: number): CrackState | undefined {
    let broken = 0, shear = 0, parted = false;
    for (const one of crack.breaks) {
        if (one.time > time) continue;
        broken += 1;
        if (one.shear) shear += 1;
        if (one.last) parted = true;
    }
    return broken === 0 ? undefined : {shear: 2 * shear > broken, parted, since: crack.breaks[0]!.time};
}

export interface BrokenSoFar {
    tension: number; // bonded points
    shear: number;
}

/// Number of bonded points broken up to a time, inclusive, since a frame written right after a break has its time.
export function brokenUntil(events: Events, time: number): BrokenSoFar {
    const counts = {tension: 0, shear: 0};
    for (let event = 0; event < events.count; ++event) {
        if (events.time[event]! <= time) counts[events.shear[event] === 1 ? 'shear' : 'tension'] += 1;
    }
    return counts;
}
