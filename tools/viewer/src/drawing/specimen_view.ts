// SPDX-License-Identifier: GPL-3.0-or-later
// One test as drawn by the viewer: its frames, cracks and lines, and the three.js scene that contains them.

import {Scene} from 'three';

import type {Colouring} from '../colours/colouring';
import type {Theme} from '../colours/theme';
import {jaggedCells, reach, type Point} from '../data/cells';
import {Frames, type Frame} from '../data/frames';
import type {Bonds, TestData} from '../data/report';
import type {LabelledTest} from '../data/test_labels';
import {findCracks, type Crack} from '../geometry/cracks';
import {extentAtStart, type Extent} from '../geometry/extent';
import type {ForceScale} from '../quantities/ranges';
import {addBonds, addChains, addCracks, addForces, addOutlines, addPicked, type CrackColours} from './drawn_lines';
import {ParticleLayer} from './particle_layer';
import {SegmentLayer} from './segment_layer';
import {Segments} from './segments';
import {layerNames, type Layer, type Settings} from './settings';

const highestBand = 0.25; // half the width of the widest band of faces, relative to a particle's size

/// Everything that decides how a test looks at one moment.
export interface Look {
    settings: Settings;
    colouring: Colouring;
    crackColours: CrackColours;
    forceScale: ForceScale;
    picked: number | undefined; // index of the picked cell
    opacity: number;
    offered: ReadonlySet<Layer>; // layers that have something to show
    theme: Theme;
}

export class SpecimenView {
    readonly frames: Frames;
    readonly scene = new Scene();
    readonly extent: Extent; // m, first frame
    readonly origin: Point;
    readonly meanSize: number; // m, about a particle's diameter
    private readonly jagged: readonly number[]; // cells
    private readonly forceLines: number;
    readonly lines: Segments; // platens, cracks, bonds, and the outline of the picked particle
    readonly forces: Segments; // widths are relative to the widest line
    private madeParticles: ParticleLayer | undefined;
    private readonly lineLayer = new SegmentLayer(1);
    private readonly forceLayer = new SegmentLayer(2);
    private found: Crack[] | undefined;

    constructor(readonly labelled: LabelledTest) {
        const {test} = labelled;
        this.frames = new Frames(test);
        this.extent = extentAtStart(test);
        this.origin = {x: (this.extent.x1 + this.extent.x2) / 2, y: (this.extent.y1 + this.extent.y2) / 2};
        this.lines = new Segments(this.origin);
        this.forces = new Segments(this.origin);
        this.scene.add(this.lineLayer.mesh, this.forceLayer.mesh);
        const stride = Math.max(1, Math.floor(test.cells.count / 500));
        let sum = 0, measured = 0;
        for (let cell = 0; cell < test.cells.count; cell += stride) {
            if (test.cells.open[cell] === 1) continue;
            sum += 2 * reach(test.cells, cell);
            measured += 1;
        }
        this.meanSize = measured > 0 ? sum / measured : 1;
        this.jagged = jaggedCells(test.cells);
        this.forceLines = Math.sqrt(pointsOfPair(test.bonds));
    }

    get test(): TestData {
        return this.labelled.test;
    }

    /// Created when first shown, since the reader may not view every test of a report.
    private get particles(): ParticleLayer {
        if (!this.madeParticles) {
            this.madeParticles = new ParticleLayer(this.test.cells, this.origin, this.jagged);
            this.scene.add(this.madeParticles.group);
        }
        return this.madeParticles;
    }

    /// Layers for which the test has data.
    get layers(): Layer[] {
        const {bonds, cells, events, walls} = this.test;
        const missing: Partial<Record<Layer, boolean>> = {
            platens: !walls && !cells.open.includes(1),
            cracks: events.count === 0 && !this.frames.has('state'),
            bonds: bonds.count === 0,
            forces: !this.frames.has('fn') && !this.frames.has('contacts.fn'),
        };
        return (Object.keys(layerNames) as Layer[]).filter((layer) => !missing[layer]);
    }

    /// Whether there is a list of breaks. A test always has one, which may be empty; the run of a deck may have none.
    get listsBreaks(): boolean {
        return this.test.events.count > 0 || this.test.source === 'test';
    }

    get cracks(): Crack[] {
        return this.found ??= findCracks(this.test.cells, this.test.events);
    }

    /// Fills `lines` and `forces` for a frame. Also used for the SVG file.
    fillLines(frame: Frame, look: Look): void {
        const {settings, theme} = look, {layers, magnification} = settings;
        this.lines.clear();
        this.forces.clear();
        if (layers.particles && layers.outlines) addOutlines(this.lines, this.test.cells, frame, this.jagged, magnification, theme);
        if (layers.bonds) addBonds(this.lines, this.test, frame, magnification, theme);
        if (layers.platens) addChains(this.lines, this.test, frame, magnification, theme);
        if (layers.cracks) addCracks(this.lines, this.test, this.cracks, frame, magnification, look.crackColours, theme);
        if (look.picked !== undefined) addPicked(this.lines, this.test.cells, frame, look.picked, magnification, theme);
        if (layers.forces) addForces(this.forces, this.test, frame, magnification, look.forceScale, highestBand * this.meanSize, theme);
    }

    /// Width of the line for the largest force, px. It is smaller if faces have several points, whose lines lie side by side.
    widestForce(pixelsPerMetre: number): number {
        return Math.min(20, Math.max(1.5, (0.22 * this.meanSize * pixelsPerMetre) / this.forceLines));
    }

    show(frame: Frame, look: Look): void {
        this.particles.group.visible = look.settings.layers.particles;
        this.particles.setPalette(look.colouring.palette, look.theme.grainEdge);
        this.particles.setOpacity(look.opacity);
        this.particles.show(frame, look.settings.magnification, look.colouring);
        this.fillLines(frame, look);
        this.lineLayer.show(this.lines);
        this.forceLayer.show(this.forces);
    }

    /// Call this before each drawing.
    prepare({width, height, ratio, pixelsPerMetre, seen, outlines, moving}: Drawn): void {
        const particlePixels = this.meanSize * pixelsPerMetre;
        this.lineLayer.setScale(width * ratio, height * ratio, ratio * lineScale(particlePixels));
        this.forceLayer.setScale(width * ratio, height * ratio, ratio * this.widestForce(pixelsPerMetre));
        const {width: edge, strength} = outlineOf(particlePixels);
        this.particles.prepare(seen, pixelsPerMetre * ratio, outlines ? {width: edge * ratio, strength} : {width: 0, strength: 0}, moving);
    }
}

/// Sizes and settings for drawing a pane.
export interface Drawn {
    width: number; // CSS pixels
    height: number;
    ratio: number; // picture pixels per CSS pixel
    pixelsPerMetre: number; // in CSS pixels
    seen: Extent; // m, visible area relative to the specimen's origin
    outlines: boolean;
    moving: boolean;
}

/// Mean number of bonded points per pair of cells. Pairs of circles have one, faces of polygons several, which are adjacent.
function pointsOfPair({count, i, j}: Bonds): number {
    let pairs = 0;
    for (let bond = 0; bond < count; ++bond) if (bond === 0 || i[bond] !== i[bond - 1] || j[bond] !== j[bond - 1]) ++pairs;
    return pairs > 0 ? count / pairs : 1;
}

/// Scale of line widths. Lines are thinner for small particles, since cracks would otherwise hide the specimen.
export function lineScale(particlePixels: number): number {
    return Math.min(1, Math.max(0.4, particlePixels / 10));
}

const thinnestOutline = 0.7; // px; thinner outlines would appear broken

/// Width of an outline, px, and the strength of its colour. The width is proportional to the particle size, so that the fill
/// remains visible. Very small particles have no outline, since they would look grey all over.
export function outlineOf(particlePixels: number): {width: number; strength: number} {
    const share = particlePixels < 6 ? 0 : Math.min(1.1, 0.028 * particlePixels);
    return {width: share > 0 ? Math.max(thinnestOutline, share) : 0, strength: Math.min(1, share / thinnestOutline)};
}
