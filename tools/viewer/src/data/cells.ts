// SPDX-License-Identifier: GPL-3.0-or-later
// Cells are the drawn elements of bodies in the first frame: circles, polygons and open chains (platens, wall segments).
// A clump has a cell for each of its circles, all with the clump's id.

import type {NumberArray} from './plain_arrays';

export interface Point {
    x: number;
    y: number;
}

export interface Cells {
    count: number;
    id: NumberArray; // ids of the bodies in the input
    radius: NumberArray; // m; 0 for polygons and open chains
    open: NumberArray; // 1 for an open chain
    platen: NumberArray; // 1 for a platen
    material: NumberArray; // numbers of the materials, starting at 1
    x: NumberArray; // m, centre (mean of the outline's corners), the reference point of the motion
    y: NumberArray;
    firstPoint: NumberArray; // count + 1 indices of first points in the outlines; circles have no points
    outlineX: NumberArray; // m
    outlineY: NumberArray;
}

export function outline(cells: Cells, cell: number): Point[] {
    const points: Point[] = [];
    for (let at = cells.firstPoint[cell]!; at < cells.firstPoint[cell + 1]!; ++at) points.push({x: cells.outlineX[at]!, y: cells.outlineY[at]!});
    return points;
}

export function centre(cells: Cells, cell: number): Point {
    return {x: cells.x[cell]!, y: cells.y[cell]!};
}

/// Largest distance from a cell's centre to a point of the cell, m.
export function reach(cells: Cells, cell: number): number {
    let farthest = cells.radius[cell]!;
    for (let at = cells.firstPoint[cell]!; at < cells.firstPoint[cell + 1]!; ++at) {
        farthest = Math.max(farthest, Math.hypot(cells.outlineX[at]! - cells.x[cell]!, cells.outlineY[at]! - cells.y[cell]!));
    }
    return farthest;
}

/// Area of a cell, m²; 0 for open chains.
export function area(cells: Cells, cell: number): number {
    if (cells.open[cell] === 1) return 0;
    if (cells.radius[cell]! > 0) return Math.PI * cells.radius[cell]! ** 2;
    const points = outline(cells, cell);
    return 0.5 * Math.abs(points.reduce((sum, a, at) => {
        const b = points[(at + 1) % points.length]!;
        return sum + a.x * b.y - a.y * b.x;
    }, 0));
}

/// Whether a polygon is star-shaped about its centre, that is, its corners run around the centre in one direction.
function isStar({firstPoint, outlineX, outlineY, x, y}: Cells, cell: number): boolean {
    const begin = firstPoint[cell]!, end = firstPoint[cell + 1]!, x0 = x[cell]!, y0 = y[cell]!;
    let left = 0;
    for (let from = end - 1, to = begin; to < end; from = to++) {
        if ((outlineX[from]! - x0) * (outlineY[to]! - y0) > (outlineY[from]! - y0) * (outlineX[to]! - x0)) ++left;
    }
    return left === 0 || left === end - begin;
}

/// Closed polygons that are not star-shaped.
export function jaggedCells(cells: Cells): number[] {
    const jagged: number[] = [];
    for (let cell = 0; cell < cells.count; ++cell) if (cells.open[cell] !== 1 && cells.radius[cell] === 0 && !isStar(cells, cell)) jagged.push(cell);
    return jagged;
}

/// Number of bodies; a clump counts as one.
export function particleCount(cells: Cells): number {
    const ids = new Set<number>();
    for (let cell = 0; cell < cells.count; ++cell) if (cells.open[cell] !== 1) ids.add(cells.id[cell]!);
    return ids.size;
}
