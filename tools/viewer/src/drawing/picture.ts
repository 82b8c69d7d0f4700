// SPDX-License-Identifier: GPL-3.0-or-later
// The complete picture: the WebGL stage with titles, legend and numbers over it. For files it is drawn again at any resolution.
// On the page, text is SVG, because without a graphics card a transparent canvas over the picture would take longer to draw
// than all particles.

import type {Theme} from '../colours/theme';
import type {Frame} from '../data/frames';
import {element, svgElement} from '../elements/dom';
import {CanvasSheet, SvgSheet, type Sheet} from '../elements/sheet';
import {TextOverlay} from '../elements/text_overlay';
import {drawNumberNote, drawNumbers, drawScaleBar, drawTitles, magnified, momentText, type Numbered} from './annotations';
import {drawLegend, legendHeight} from './legend';
import {paneAsSvg} from './picture_svg';
import type {Look, SpecimenView} from './specimen_view';
import {fit, footRoom, grid, Stage, titleRoom, type Pane} from './stage';

export interface Shown {
    view: SpecimenView;
    frame: Frame;
    look: Look;
}

export class Picture {
    readonly stage = new Stage();
    readonly element = element('div', {class: 'picture'});
    shown = new Map<SpecimenView, Shown>();
    width = 0;
    height = 0;
    private theme: Theme | undefined;
    private overlays: {title: TextOverlay; foot: TextOverlay}[] = []; // by pane
    private readonly legend = new TextOverlay();
    private readonly numbers = new TextOverlay();

    constructor() {
        this.stage.onDrawn = () => this.place();
    }

    /// Divides the picture into panes, with the same scale for all specimens if their sizes allow it.
    layOut(panes: readonly (readonly SpecimenView[])[], width: number, height: number): void {
        this.width = width;
        this.height = height;
        const views = panes.flat();
        const aspect = Math.max(...views.map(({extent}) => (extent.x2 - extent.x1) / (extent.y2 - extent.y1)));
        const rectangles = grid(panes.length, width, height - legendHeight, aspect);
        const scales = panes.map((pane, at) => Math.min(...pane.map((view) => fit(view.extent, rectangles[at]!))));
        const smallest = Math.min(...scales), shared = Math.max(...scales) < 2 * smallest;
        this.stage.panes = panes.map((pane, at) => ({rectangle: rectangles[at]!, views: pane, pixelsPerMetre: shared ? smallest : scales[at]!}));
        this.stage.resize(width, height);
        this.overlays = panes.map(() => ({title: new TextOverlay(), foot: new TextOverlay()}));
        this.element.replaceChildren(this.stage.canvas, this.numbers.svg, ...this.overlays.flatMap(({title, foot}) => [title.svg, foot.svg]), this.legend.svg);
    }

    show(shown: Shown[], theme: Theme): void {
        this.theme = theme;
        this.shown = new Map(shown.map((one) => [one.view, one]));
        for (const {view, frame, look} of shown) view.show(frame, look);
        this.stage.outlines = shown[0]?.look.settings.layers.outlines ?? true;
        this.stage.setBackground(theme.background);
        this.write();
        this.stage.request();
    }

    /// Draws the whole picture on a canvas. @param ratio  picture pixels per CSS pixel
    compose(ratio: number, into = element('canvas')): HTMLCanvasElement {
        into.width = Math.round(this.width * ratio);
        into.height = Math.round(this.height * ratio);
        this.stage.draw(ratio);
        const context = into.getContext('2d', {willReadFrequently: true})!;
        context.drawImage(this.stage.canvas, 0, 0, into.width, into.height);
        context.scale(ratio, ratio);
        this.annotate(new CanvasSheet(context));
        this.stage.request();
        return into;
    }

    asSvg(): SVGElement {
        const svg = svgElement('svg', {viewBox: `0 0 ${this.width} ${this.height}`, width: this.width, height: this.height});
        svg.append(svgElement('rect', {width: this.width, height: this.height, fill: this.theme!.background}));
        for (const pane of this.stage.panes) svg.append(paneAsSvg(pane, this.stage.placing(pane), this.shownIn(pane)));
        this.annotate(new SvgSheet(svg));
        return svg;
    }

    private shownIn(pane: Pane): Shown[] {
        return pane.views.flatMap((view) => this.shown.get(view) ?? []);
    }

    /// Updates the text that changes with the moment.
    private write(): void {
        for (const [at, pane] of this.stage.panes.entries()) {
            const {x, y, width} = pane.rectangle;
            this.overlays[at]!.title.write({x, y, width, height: titleRoom}, (sheet) => this.writeTitle(sheet, pane));
        }
        this.legend.write({x: 0, y: this.height - legendHeight, width: this.width, height: legendHeight}, (sheet) => this.writeLegend(sheet));
    }

    /// Updates the text that changes with pan and zoom.
    private place(): void {
        for (const [at, pane] of this.stage.panes.entries()) {
            const {x, y, width, height} = pane.rectangle;
            this.overlays[at]!.foot.write({x, y: y + height - footRoom, width: Math.min(width, 260), height: footRoom}, (sheet) => this.writeScale(sheet, pane));
        }
        const numbered = [...this.shown.values()].some(({look}) => look.settings.layers.numbers);
        this.numbers.svg.toggleAttribute('hidden', !numbered);
        if (numbered) this.numbers.write({x: 0, y: 0, width: this.width, height: this.height}, (sheet) => this.stage.panes.forEach((pane) => this.writeNumbersWithNote(sheet, pane)));
    }

    private annotate(sheet: Sheet): void {
        for (const pane of this.stage.panes) {
            this.writeNumbers(sheet, pane);
            this.writeTitle(sheet, pane);
            this.writeScale(sheet, pane);
        }
        this.writeLegend(sheet);
    }

    private writeTitle(sheet: Sheet, pane: Pane): void {
        const theme = this.theme!, inPane = this.shownIn(pane);
        drawTitles(sheet, pane, inPane.map(({view, frame, look}, at) => ({
            label: view.labelled.label, moment: momentText(frame, view.test) + magnified(look.settings.magnification), colour: inPane.length > 1 ? theme.overlaid[at % 2]! : theme.ink,
        })), theme);
    }

    private writeNumbers(sheet: Sheet, pane: Pane): Numbered {
        const all = {shown: 0, all: 0};
        for (const {view, frame, look} of this.shownIn(pane)) {
            if (!look.settings.layers.numbers) continue;
            const one = drawNumbers(sheet, pane, this.stage.placing(pane), view, frame, look.settings.magnification, look.theme);
            all.shown += one.shown;
            all.all += one.all;
        }
        return all;
    }

    /// Writes the numbers, and a note to zoom in if some are missing. Files have no such note.
    private writeNumbersWithNote(sheet: Sheet, pane: Pane): void {
        const numbered = this.writeNumbers(sheet, pane);
        if (this.theme) drawNumberNote(sheet, pane, numbered, this.theme);
    }

    private writeScale(sheet: Sheet, pane: Pane): void {
        if (this.theme) drawScaleBar(sheet, pane, this.stage.placing(pane), this.theme);
    }

    private writeLegend(sheet: Sheet): void {
        const look = [...this.shown.values()][0]?.look;
        if (look) drawLegend(sheet, look, 10, this.height - legendHeight + 2);
    }
}
