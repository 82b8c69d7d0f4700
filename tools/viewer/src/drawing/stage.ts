// SPDX-License-Identifier: GPL-3.0-or-later
// The WebGL picture: one canvas divided into panes, each of which shows a test or several overlaid tests. It is drawn only
// after changes, at one picture pixel per CSS pixel while it moves, and again at a finer resolution once it is at rest.

import {ColorManagement, OrthographicCamera, WebGLRenderer} from 'three';

import type {Rectangle} from '../elements/sheet';
import type {Extent} from '../geometry/extent';
import type {SpecimenView} from './specimen_view';

/// Pan and zoom as defined by d3-zoom: shown position = k · fitted position + (x, y), in pixels of a pane.
export interface PanZoom {
    k: number;
    x: number;
    y: number;
}

/// Placing of a specimen in a pane: shown x = x + scale · (world x - origin x); y likewise, but downwards.
export interface Placing {
    scale: number; // CSS pixels per metre
    x: number;
    y: number;
}

export interface Pane {
    rectangle: Rectangle;
    views: readonly SpecimenView[];
    pixelsPerMetre: number; // scale at which the specimen fits the pane
}

ColorManagement.enabled = false; // colours are passed unchanged

const restTime = 180; // ms without a change before the fine picture is drawn
const largestPicture = 9e6; // largest number of picture pixels at rest
export const titleRoom = 40, footRoom = 26, sideRoom = 10; // px in a pane, for text

export class Stage {
    readonly canvas: HTMLCanvasElement;
    panes: Pane[] = [];
    panZoom: PanZoom = {k: 1, x: 0, y: 0};
    outlines = true;
    onDrawn: () => void = () => {};
    private readonly renderer: WebGLRenderer;
    private readonly camera = new OrthographicCamera();
    private width = 1;
    private height = 1;
    private wanted = 0; // id of the requested animation frame
    private resting = 0; // id of the timer for the fine picture

    /// @throws Error if the browser has no WebGL 2
    constructor() {
        this.renderer = new WebGLRenderer({antialias: false, alpha: false, depth: false, stencil: false, powerPreference: 'high-performance'});
        this.renderer.autoClear = false;
        this.renderer.outputColorSpace = 'srgb-linear';
        this.canvas = this.renderer.domElement;
        this.camera.position.z = 1;
    }

    resize(width: number, height: number): void {
        this.width = width;
        this.height = height;
    }

    setBackground(colour: string): void {
        this.renderer.setClearColor(colour);
    }

    /// Draws soon, and at fine resolution once nothing has changed for a while.
    request(): void {
        this.wanted ||= requestAnimationFrame(() => this.drawMoving());
    }

    /// Draws at once, as fast as possible; this also fulfils a pending request.
    drawMoving(): void {
        cancelAnimationFrame(this.wanted);
        clearTimeout(this.resting);
        this.wanted = 0;
        this.draw(Math.min(1, devicePixelRatio), true);
        this.onDrawn();
        // The timer starts only now, so that a slow drawing is not followed by a slower one while the user still drags.
        this.resting = window.setTimeout(() => {
            if (!this.wanted) this.draw(this.stillRatio());
        }, restTime);
    }

    /// Draws at once at fine resolution.
    drawStill(): void {
        cancelAnimationFrame(this.wanted);
        this.wanted = 0;
        this.draw(this.stillRatio());
        this.onDrawn();
    }

    /// Draws the picture, which can be read until the browser next paints. @param ratio  picture pixels per CSS pixel
    draw(ratio: number, moving = false): void {
        const {renderer} = this;
        if (renderer.getPixelRatio() !== ratio || this.canvas.style.width !== `${this.width}px` || this.canvas.style.height !== `${this.height}px`) {
            renderer.setPixelRatio(ratio);
            renderer.setSize(this.width, this.height);
        }
        renderer.setScissorTest(false);
        renderer.clear();
        renderer.setScissorTest(true);
        for (const pane of this.panes) {
            const {x, y, width, height} = pane.rectangle;
            renderer.setViewport(x, this.height - y - height, width, height);
            renderer.setScissor(x, this.height - y - height, width, height);
            const placing = this.placing(pane), {scale} = placing;
            const seen = {x1: -placing.x / scale, x2: (width - placing.x) / scale, y1: (placing.y - height) / scale, y2: placing.y / scale};
            [this.camera.left, this.camera.right, this.camera.bottom, this.camera.top] = [seen.x1, seen.x2, seen.y1, seen.y2];
            this.camera.updateProjectionMatrix();
            for (const view of pane.views) {
                view.prepare({width, height, ratio, pixelsPerMetre: scale, seen, outlines: this.outlines, moving});
                renderer.render(view.scene, this.camera);
            }
        }
    }

    /// Blocks until the picture is finished. Only for measurements, since browsers print warnings on the console.
    finish(): void {
        const gl = this.renderer.getContext();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }

    /// Resolves when the picture is finished, to within some milliseconds.
    async finished(): Promise<void> {
        const gl = this.renderer.getContext() as WebGL2RenderingContext, fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        if (!fence) return; // the context is lost
        gl.flush();
        while (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED) await new Promise((resume) => setTimeout(resume));
        gl.deleteSync(fence);
    }

    stillRatio(): number {
        const fine = 2 * Math.max(1, devicePixelRatio); // the browser smooths by scaling down, since WebGL does not
        return Math.max(1, Math.min(fine, Math.sqrt(largestPicture / (this.width * this.height))));
    }

    placing(pane: Pane): Placing {
        const {k, x, y} = this.panZoom, {width, height} = pane.rectangle;
        return {scale: pane.pixelsPerMetre * k, x: k * width / 2 + x, y: k * (titleRoom + height - footRoom) / 2 + y};
    }
}

/// Pixels per metre at which an extent fills a pane.
export function fit(extent: Extent, {width, height}: Rectangle): number {
    return Math.max(1e-9, Math.min((width - 2 * sideRoom) / (extent.x2 - extent.x1), (height - titleRoom - footRoom) / (extent.y2 - extent.y1)));
}

const leastPane = 136; // px, width needed for the name of a test

/// A grid of panes that shows specimens of this aspect ratio as large as possible.
export function grid(count: number, width: number, height: number, aspect: number): Rectangle[] {
    let best = {columns: 1, size: 0};
    const most = Math.max(2, Math.floor(width / leastPane));
    for (let columns = 1; columns <= Math.min(count, most); ++columns) {
        const rows = Math.ceil(count / columns);
        const size = Math.min(width / columns - 2 * sideRoom, (height / rows - titleRoom - footRoom) * aspect);
        if (size > 1.1 * best.size) best = {columns, size};
    }
    const rows = Math.ceil(count / best.columns), w = Math.floor(width / best.columns), h = Math.floor(height / rows);
    return Array.from({length: count}, (_, at) => ({x: (at % best.columns) * w, y: Math.floor(at / best.columns) * h, width: w, height: h}));
}
