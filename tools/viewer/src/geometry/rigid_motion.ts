// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motion of the cells since the first frame, with displacements magnified.
//   corner' = centre + m u + R(φ)(corner - centre),   φ = max(|angle|, min(m |angle|, 0.5)) in the sense of the angle
// with displacement u [m] and magnification m. Angles are magnified only up to half a radian, beyond which a magnified rotation
// has no meaning. They are never drawn smaller than they are.

import type {Cells, Point} from '../data/cells';
import type {Frame} from '../data/frames';

export const largestMagnifiedAngle = 0.5; // rad

export function magnifiedAngle(angle: number, magnification: number): number {
    const size = Math.abs(angle);
    return Math.sign(angle) * Math.max(size, Math.min(magnification * size, largestMagnifiedAngle));
}

/// Maps points of a cell in the first frame to their current positions.
export type Mover = (point: Point) => Point;

export function moverOf(cells: Cells, frame: Frame, cell: number, magnification: number): Mover {
    const x = cells.x[cell]!, y = cells.y[cell]!;
    const toX = x + magnification * frame.ux[cell]!, toY = y + magnification * frame.uy[cell]!;
    const angle = magnifiedAngle(frame.angle[cell]!, magnification);
    const cos = Math.cos(angle), sin = Math.sin(angle);
    return (point) => ({
        x: toX + cos * (point.x - x) - sin * (point.y - y),
        y: toY + sin * (point.x - x) + cos * (point.y - y),
    });
}

export function movedCentre(cells: Cells, frame: Frame, cell: number, magnification: number): Point {
    return {x: cells.x[cell]! + magnification * frame.ux[cell]!, y: cells.y[cell]! + magnification * frame.uy[cell]!};
}
