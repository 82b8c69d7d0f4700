// SPDX-License-Identifier: GPL-3.0-or-later
// window.crackle: access to the viewer's state for browser tests and measurements. The page itself does not use it.

import type {Viewer} from './viewer';

export function expose(viewer: Viewer): void {
    const {stage} = viewer.picture;
    Object.defineProperty(window, 'crackle', {value: Object.freeze({
        /// For each test on the screen: its name, and the index and time of its frame.
        shown: () => [...viewer.picture.shown.values()].map(({view, frame}) => ({test: view.test.name, frame: frame.index, time: frame.time})),
        moment: () => viewer.clock.moment,
        playing: () => viewer.clock.playing,
        settings: () => structuredClone(viewer.settings),
        picked: () => viewer.picked && {test: viewer.picked.view.test.name, id: viewer.picked.view.test.cells.id[viewer.picked.cell]},
        zoom: () => ({...stage.panZoom}),
        settled: () => viewer.scaled(),
        /// Position on the page of a particle of a test, in CSS pixels.
        place: (name: string, id: number) => viewer.placeOf(name, id),
        /// Draws at the resolution used while the picture moves, and waits until drawing is finished.
        draw: () => {
            stage.drawMoving();
            stage.finish();
        },
    })});
}
