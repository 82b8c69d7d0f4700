// SPDX-License-Identifier: GPL-3.0-or-later
// Pan and zoom by mouse, wheel and touch (d3-zoom), synchronised over all panes.

import {select} from 'd3-selection';
import {zoom, ZoomTransform, zoomIdentity, type ZoomBehavior} from 'd3-zoom';

type Zoomed = HTMLElement & {__zoom?: ZoomTransform}; // property in which d3-zoom keeps an element's state

export class Navigation {
    private transform: ZoomTransform = zoomIdentity;
    private panes: Zoomed[] = [];
    private readonly behaviour: ZoomBehavior<Zoomed, unknown>;

    /// @param wheelZooms  whether a wheel event zooms the picture rather than scrolls the page
    constructor(onChange: (transform: ZoomTransform) => void, wheelZooms: (event: WheelEvent) => boolean) {
        this.behaviour = zoom<Zoomed, unknown>()
            .scaleExtent([0.2, 400])
            .filter((event: Event) => (event.type === 'wheel' ? wheelZooms(event as WheelEvent) : !(event as MouseEvent).button))
            .on('zoom', (event: {transform: ZoomTransform}) => {
                this.transform = event.transform;
                for (const pane of this.panes) pane.__zoom = event.transform;
                onChange(event.transform);
            });
    }

    attach(panes: HTMLElement[]): void {
        this.panes = panes;
        for (const pane of this.panes) {
            select(pane).call(this.behaviour).on('dblclick.zoom', null).on('dblclick', () => this.fit());
            (pane as Zoomed).__zoom = this.transform;
        }
    }

    scaleBy(factor: number): void {
        if (this.panes[0]) select(this.panes[0]).call(this.behaviour.scaleBy, factor);
    }

    fit(): void {
        if (this.panes[0]) select(this.panes[0]).call(this.behaviour.transform, zoomIdentity);
    }
}
