// SPDX-License-Identifier: GPL-3.0-or-later
// Where broken bonds are drawn: on the two faces that the bond held together, which move with their own bodies, so that an
// open crack shows both its sides. Faces are found once, in the first frame, where the bodies still lie against each other.
//   circle on circle      a tangent at the contact point of each
//   polygon or platen     the parts of the two nearest parallel edges that face each other; where none do (corner on
//                         corner), short ticks across the line of the two nearest corners

import type {Bodies, Events} from './data';

export interface Point {
    x: number;
    y: number;
}

type Segment = [Point, Point];

/// One side of a broken interface: a line that moves with its body.
export interface CrackFace {
    body: number; // index into Bodies
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

export function outline(bodies: Bodies, body: number): Point[] {
    const points: Point[] = [];
    for (let at = bodies.firstPoint[body]!; at < bodies.firstPoint[body + 1]!; ++at) points.push({x: bodies.x[at]!, y: bodies.y[at]!});
    return points;
}

function edges(bodies: Bodies, body: number): Segment[] {
    const points = outline(bodies, body);
    const joined: Segment[] = points.slice(1).map((point, index) => [points[index]!, point]);
    if (bodies.open[body] !== 1 && points.length > 2) joined.push([points[points.length - 1]!, points[0]!]);
    return joined;
}

export function centre(bodies: Bodies, body: number): Point {
    const points = outline(bodies, body);
    const sum = points.reduce((total, point) => ({x: total.x + point.x, y: total.y + point.y}), {x: 0, y: 0});
    return {x: sum.x / points.length, y: sum.y / points.length};
}

function nearestOn([a, b]: Segment, point: Point): Point {
    const direction = minus(b, a);
    const share = dot(minus(point, a), direction) / Math.max(dot(direction, direction), Number.MIN_VALUE);
    return along(a, direction, Math.min(1, Math.max(0, share)));
}

const tick = (body: number, at: Point, normal: Point, half: number): CrackFace => {
    const tangent = {x: -normal.y, y: normal.x};
    return {body, from: along(at, tangent, -half), to: along(at, tangent, half)};
};

function circleFaces(bodies: Bodies, circle: number, other: number): CrackFace[] {
    const from = centre(bodies, circle);
    const radius = bodies.radius[circle]!;
    if (bodies.radius[other]! > 0) {
        const to = centre(bodies, other);
        const normal = unit(minus(to, from));
        const half = 0.6 * Math.min(radius, bodies.radius[other]!);
        return [tick(circle, along(from, normal, radius), normal, half), tick(other, along(to, normal, -bodies.radius[other]!), normal, half)];
    }
    const candidates = edges(bodies, other).map((edge) => nearestOn(edge, from));
    const nearest = candidates.reduce((best, point) =>
        (Math.hypot(point.x - from.x, point.y - from.y) < Math.hypot(best.x - from.x, best.y - from.y) ? point : best));
    const normal = unit(minus(nearest, from));
    return [tick(circle, along(from, normal, radius), normal, 0.6 * radius), tick(other, nearest, normal, 0.6 * radius)];
}

/// The stretches of two nearly parallel edges that lie over each other, and how far apart they are.
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

function outlineFaces(bodies: Bodies, i: number, j: number): CrackFace[] {
    let best: ReturnType<typeof facing>;
    for (const a of edges(bodies, i)) {
        for (const b of edges(bodies, j)) {
            const found = facing(a, b);
            // A long overlap counts, a wide gap counts more against it: edges on the far sides lose.
            if (found && found.gap < found.length && (!best || found.length - 4 * found.gap > best.length - 4 * best.gap)) best = found;
        }
    }
    if (best) return [{body: i, from: best.first[0], to: best.first[1]}, {body: j, from: best.second[0], to: best.second[1]}];

    let nearest: {a: Point; b: Point; distance: number} | undefined;
    const consider = (a: Point, b: Point) => {
        const distance = Math.hypot(a.x - b.x, a.y - b.y);
        if (!nearest || distance < nearest.distance) nearest = {a, b, distance};
    };
    for (const corner of outline(bodies, i)) for (const edge of edges(bodies, j)) consider(corner, nearestOn(edge, corner));
    for (const corner of outline(bodies, j)) for (const edge of edges(bodies, i)) consider(nearestOn(edge, corner), corner);
    if (!nearest) return [];
    const normal = unit(minus(nearest.b, nearest.a));
    const half = Math.max(2 * nearest.distance, 0.1 * Math.min(size(bodies, i), size(bodies, j)));
    return [tick(i, nearest.a, normal, half), tick(j, nearest.b, normal, half)];
}

function size(bodies: Bodies, body: number): number {
    const points = outline(bodies, body);
    const middle = centre(bodies, body);
    return Math.max(...points.map((point) => Math.hypot(point.x - middle.x, point.y - middle.y)));
}

function facesOf(bodies: Bodies, i: number, j: number): CrackFace[] {
    if (bodies.radius[i]! > 0) return circleFaces(bodies, i, j);
    if (bodies.radius[j]! > 0) return circleFaces(bodies, j, i);
    return outlineFaces(bodies, i, j);
}

/// How far the surfaces of two drawn elements are apart, about: tells which circles of two clumps touched.
function gap(bodies: Bodies, i: number, j: number): number {
    const a = centre(bodies, i), b = centre(bodies, j);
    return Math.hypot(a.x - b.x, a.y - b.y) - bodies.radius[i]! - bodies.radius[j]!;
}

/// One crack a pair of bodies, in the order of their first breaks.
export function findCracks(bodies: Bodies, events: Events): Crack[] {
    const elementsOf = new Map<number, number[]>(); // several for a clump
    for (let element = 0; element < bodies.id.length; ++element) {
        const id = bodies.id[element]!;
        elementsOf.set(id, [...(elementsOf.get(id) ?? []), element]);
    }
    const cracks = new Map<string, Crack>();
    for (let event = 0; event < events.count; ++event) {
        const ids = [events.bodyI[event]!, events.bodyJ[event]!] as const;
        const key = ids[0] < ids[1] ? `${ids[0]} ${ids[1]}` : `${ids[1]} ${ids[0]}`;
        let crack = cracks.get(key);
        if (!crack) {
            const pairs = (elementsOf.get(ids[0]) ?? []).flatMap((i) => (elementsOf.get(ids[1]) ?? []).map((j) => ({i, j, gap: gap(bodies, i, j)})));
            if (pairs.length === 0) throw new Error(`break ${event + 1}: body ${ids[0]} or ${ids[1]} is not drawn`);
            const {i, j} = pairs.reduce((best, pair) => (pair.gap < best.gap ? pair : best));
            crack = {faces: facesOf(bodies, i, j), breaks: []};
            cracks.set(key, crack);
        }
        crack.breaks.push({time: events.time[event]!, shear: events.shear[event] === 1, last: events.last[event] === 1});
    }
    return [...cracks.values()];
}
