// SPDX-License-Identifier: GPL-3.0-or-later
// Draws all circles and polygons of a test as one three.js mesh. Corners are uploaded once. A frame is one small
// texture with displacement, angle and palette index of each cell, and the vertex shader applies the rigid motion.
// Panning and zooming change only the camera. Circles are drawn as squares, and polygons that are star-shaped about
// their centre as fans. The length of `rim` grows from 0 at the centre to 1 at the outline. It gives circles their
// shape, and outlines the same width in pixels at any zoom. Other polygons are triangulated, and their outlines are
// drawn as lines (drawn_lines.ts). Software WebGL needs about a microsecond per triangle, whatever its size, so only
// batches of neighbouring cells in view are drawn. If that is still too slow while the picture moves, each cell is
// drawn as a point of the same area. If there are very many cells, only an evenly distributed part of them is drawn,
// with larger points.

import {
    BufferAttribute, BufferGeometry, DataTexture, FloatType, GLSL3, Group, Mesh, NearestFilter, Points, RawShaderMaterial, RGBAFormat, ShapeUtils,
    Vector2, Vector3,
} from 'three';

import {paletteIndices, type Colouring} from '../colours/colouring';
import {paletteSize, rgb, type Rgb} from '../colours/palettes';
import {area, outline, reach, type Cells, type Point} from '../data/cells';
import type {Frame} from '../data/frames';
import type {Extent} from '../geometry/extent';
import {magnifiedAngle} from '../geometry/rigid_motion';

const textureWidth = 512; // cells per row
const batchSize = 500; // cells
/// With more outlines, cells are drawn as points while the picture moves, so that software WebGL reaches 20 pictures per second.
const mostOutlinesMoving = 8000;
const mostPointsMoving = 20000;

const placing = `
precision highp float;
precision highp int;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform highp sampler2D placements;
uniform lowp sampler2D palette;
in float cell;
flat out vec3 fill;
vec4 placed() {
    int index = int(cell);
    vec4 placement = texelFetch(placements, ivec2(index % ${textureWidth}, index / ${textureWidth}), 0);
    fill = texelFetch(palette, ivec2(int(placement.w), 0), 0).rgb;
    return placement;
}`;

const fanVertex = `${placing}
in vec4 place; // centre, and corner relative to the centre
in vec2 rim;
out vec2 toRim;
void main() {
    vec4 placement = placed();
    float c = cos(placement.z), s = sin(placement.z);
    toRim = rim;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place.xy + placement.xy + mat2(c, s, -s, c) * place.zw, 0.0, 1.0);
}`;

const fanFragment = `
precision mediump float;
uniform vec3 edge;
uniform float edgeWidth; // pixels; 0 for no outline
uniform float edgeStrength; // fraction of the outline's colour, 0 to 1
uniform float opacity;
in vec2 toRim;
flat in vec3 fill;
out vec4 colour;
void main() {
    float share = length(toRim);
    if (share > 1.0001) discard;
    float pixels = (1.0 - share) / max(fwidth(share), 1e-6);
    colour = vec4(edgeWidth > 0.0 ? mix(mix(fill, edge, edgeStrength), fill, clamp(pixels - edgeWidth + 0.5, 0.0, 1.0)) : fill, opacity);
}`;

const pointVertex = `${placing}
in vec3 spot; // centre, and side of a square with the cell's area
uniform float pointScale; // pixels per metre, enlarged to make up for cells that are not drawn
void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(spot.xy + placed().xy, 0.0, 1.0);
    gl_PointSize = max(1.0, spot.z * pointScale);
}`;

const pointFragment = `
precision mediump float;
uniform float opacity;
flat in vec3 fill;
out vec4 colour;
void main() { colour = vec4(fill, opacity); }`;

/// A batch of neighbouring cells: its part of the index buffer, and its bounding box in the current frame.
interface Batch {
    cells: number[];
    reach: number; // m, largest reach of its cells
    first: number;
    count: number;
    box: Extent; // m, relative to the origin
}

export class ParticleLayer {
    readonly group = new Group();
    private readonly fans: Mesh<BufferGeometry, RawShaderMaterial[]>;
    private readonly points: Points<BufferGeometry, RawShaderMaterial>;
    private readonly uniforms;
    private readonly placements: DataTexture;
    private readonly values: Float32Array;
    private readonly palette: DataTexture;
    private readonly batches: Batch[];

    /// @param jagged  polygons that are not star-shaped about their centre
    constructor(private readonly cells: Cells, private readonly origin: Point, jagged: readonly number[]) {
        const rows = Math.max(1, Math.ceil(cells.count / textureWidth));
        this.values = new Float32Array(4 * textureWidth * rows);
        this.placements = new DataTexture(this.values, textureWidth, rows, RGBAFormat, FloatType);
        this.palette = new DataTexture(new Uint8Array(4 * paletteSize), paletteSize, 1);
        for (const texture of [this.placements, this.palette]) texture.minFilter = texture.magFilter = NearestFilter;
        this.uniforms = {
            placements: {value: this.placements}, palette: {value: this.palette}, edge: {value: new Vector3()}, edgeWidth: {value: 1}, edgeStrength: {value: 1}, opacity: {value: 1},
            pointScale: {value: 1},
        };
        const material = (vertexShader: string, fragmentShader: string) => new RawShaderMaterial({
            glslVersion: GLSL3, vertexShader, fragmentShader, depthTest: false, depthWrite: false, uniforms: this.uniforms,
        });
        this.batches = neighbours(cells);
        this.fans = new Mesh(fanGeometry(cells, origin, jagged, this.batches), [material(fanVertex, fanFragment)]);
        this.points = new Points(pointGeometry(cells, origin), material(pointVertex, pointFragment));
        this.fans.frustumCulled = this.points.frustumCulled = false;
        this.group.add(this.fans, this.points);
    }

    show(frame: Frame, magnification: number, colouring: Colouring): void {
        const index = paletteIndices(colouring, frame, this.cells);
        for (let cell = 0, at = 0; cell < this.cells.count; ++cell) {
            this.values[at++] = magnification * frame.ux[cell]!;
            this.values[at++] = magnification * frame.uy[cell]!;
            this.values[at++] = magnifiedAngle(frame.angle[cell]!, magnification);
            this.values[at++] = index(cell);
        }
        this.placements.needsUpdate = true;
        for (const batch of this.batches) this.box(batch);
    }

    setPalette(palette: readonly Rgb[], edge: string): void {
        const bytes = this.palette.image.data as Uint8Array;
        palette.forEach(([r, g, b], at) => bytes.set([r, g, b, 255], 4 * at));
        this.palette.needsUpdate = true;
        const [r, g, b] = rgb(edge);
        this.uniforms.edge.value.set(r / 255, g / 255, b / 255);
    }

    setOpacity(opacity: number): void {
        this.uniforms.opacity.value = opacity;
        for (const material of [...this.fans.material, this.points.material]) material.transparent = opacity < 1;
    }

    /// Call this before each drawing.
    /// @param view  visible area, m, relative to the origin
    /// @param pixelsPerMetre  in picture pixels @param edge  outline, width in picture pixels
    prepare(view: Extent, pixelsPerMetre: number, edge: {width: number; strength: number}, moving: boolean): void {
        const {geometry} = this.fans;
        geometry.clearGroups();
        let seen = 0, first = 0, count = 0;
        for (const batch of this.batches) {
            const {box} = batch;
            if (box.x2 < view.x1 || box.x1 > view.x2 || box.y2 < view.y1 || box.y1 > view.y2) continue;
            seen += batch.cells.length;
            if (first + count === batch.first) {
                count += batch.count;
                continue;
            }
            geometry.addGroup(first, count, 0);
            first = batch.first;
            count = batch.count;
        }
        geometry.addGroup(first, count, 0);
        this.points.visible = moving && seen > mostOutlinesMoving;
        this.fans.visible = !this.points.visible;
        const share = Math.min(1, mostPointsMoving / Math.max(1, seen));
        this.points.geometry.setDrawRange(0, Math.ceil(share * this.cells.count));
        this.uniforms.edgeWidth.value = edge.width;
        this.uniforms.edgeStrength.value = edge.strength;
        this.uniforms.pointScale.value = pixelsPerMetre / Math.sqrt(share);
    }

    private box(batch: Batch): void {
        let x1 = Infinity, x2 = -Infinity, y1 = Infinity, y2 = -Infinity;
        for (const cell of batch.cells) {
            const x = this.cells.x[cell]! - this.origin.x + this.values[4 * cell]!, y = this.cells.y[cell]! - this.origin.y + this.values[4 * cell + 1]!;
            x1 = Math.min(x1, x);
            x2 = Math.max(x2, x);
            y1 = Math.min(y1, y);
            y2 = Math.max(y2, y);
        }
        batch.box = {x1: x1 - batch.reach, x2: x2 + batch.reach, y1: y1 - batch.reach, y2: y2 + batch.reach};
    }
}

/// Divides the closed cells into strips by height, and each strip into batches from left to right.
function neighbours(cells: Cells): Batch[] {
    const closed = Array.from({length: cells.count}, (_, cell) => cell).filter((cell) => cells.open[cell] !== 1);
    closed.sort((a, b) => cells.y[a]! - cells.y[b]!);
    const inStrip = Math.ceil(Math.sqrt(closed.length / batchSize)) * batchSize;
    const batches: Batch[] = [];
    for (let from = 0; from < closed.length; from += inStrip) {
        const strip = closed.slice(from, from + inStrip).sort((a, b) => cells.x[a]! - cells.x[b]!);
        for (let at = 0; at < strip.length; at += batchSize) {
            const members = strip.slice(at, at + batchSize);
            const farthest = members.reduce((most, cell) => Math.max(most, reach(cells, cell)), 0);
            batches.push({cells: members, reach: farthest, first: 0, count: 0, box: {x1: 0, x2: 0, y1: 0, y2: 0}});
        }
    }
    return batches;
}

/// Triangles of all batches in order; sets each batch's part of the index buffer.
function fanGeometry(cells: Cells, origin: Point, jagged: readonly number[], batches: readonly Batch[]): BufferGeometry {
    let corners = 0, triangles = 0;
    const cut = new Map(jagged.map((cell) => [cell, ShapeUtils.triangulateShape(outline(cells, cell).map(({x, y}) => new Vector2(x, y)), [])]));
    for (const batch of batches) {
        for (const cell of batch.cells) {
            const points = cells.firstPoint[cell + 1]! - cells.firstPoint[cell]!;
            corners += cells.radius[cell]! > 0 ? 4 : points + 1;
            triangles += cells.radius[cell]! > 0 ? 2 : cut.get(cell)?.length ?? points;
        }
    }
    const place = new Float32Array(4 * corners), rim = new Int8Array(2 * corners), owner = new Float32Array(corners), order = new Uint32Array(3 * triangles);
    let corner = 0, at = 0;
    const add = (cell: number, x: number, y: number, rimX: number, rimY: number) => {
        place[4 * corner] = cells.x[cell]! - origin.x;
        place[4 * corner + 1] = cells.y[cell]! - origin.y;
        place[4 * corner + 2] = x;
        place[4 * corner + 3] = y;
        rim[2 * corner] = rimX;
        rim[2 * corner + 1] = rimY;
        owner[corner++] = cell;
    };
    const triangle = (a: number, b: number, c: number) => {
        order[at++] = a;
        order[at++] = b;
        order[at++] = c;
    };
    for (const batch of batches) {
        batch.first = at;
        for (const cell of batch.cells) {
            const first = corner, r = cells.radius[cell]!;
            if (r > 0) {
                for (const [x, y] of [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const) add(cell, r * x, r * y, x, y);
                triangle(first, first + 1, first + 2);
                triangle(first, first + 2, first + 3);
                continue;
            }
            const begin = cells.firstPoint[cell]!, count = cells.firstPoint[cell + 1]! - begin;
            const faces = cut.get(cell);
            add(cell, 0, 0, 0, 0);
            for (let k = 0; k < count; ++k) {
                add(cell, cells.outlineX[begin + k]! - cells.x[cell]!, cells.outlineY[begin + k]! - cells.y[cell]!, faces ? 0 : 1, 0);
                if (!faces) triangle(first, first + 1 + k, first + 1 + (k + 1) % count);
            }
            for (const [a, b, c] of faces ?? []) triangle(first + 1 + a!, first + 1 + b!, first + 1 + c!);
        }
        batch.count = at - batch.first;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('place', new BufferAttribute(place, 4));
    geometry.setAttribute('rim', new BufferAttribute(rim, 2));
    geometry.setAttribute('cell', new BufferAttribute(owner, 1));
    geometry.setIndex(new BufferAttribute(order, 1));
    return geometry;
}

/// Points for all cells, ordered such that any number of first points is evenly distributed over all cells.
function pointGeometry(cells: Cells, origin: Point): BufferGeometry {
    const spot = new Float32Array(3 * cells.count), owner = new Float32Array(cells.count), step = coprimeStep(cells.count);
    for (let at = 0, cell = 0; at < cells.count; ++at, cell = (cell + step) % cells.count) {
        spot[3 * at] = cells.x[cell]! - origin.x;
        spot[3 * at + 1] = cells.y[cell]! - origin.y;
        spot[3 * at + 2] = Math.sqrt(area(cells, cell));
        owner[at] = cell;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('spot', new BufferAttribute(spot, 3));
    geometry.setAttribute('cell', new BufferAttribute(owner, 1));
    return geometry;
}

/// A step, coprime to `count` and near the golden ratio, so that repeated steps visit all places and spread them evenly.
function coprimeStep(count: number): number {
    const divisor = (a: number, b: number): number => (b === 0 ? a : divisor(b, a % b));
    let step = Math.max(1, Math.round(0.618034 * count));
    while (divisor(step, count) !== 1) ++step;
    return step;
}
