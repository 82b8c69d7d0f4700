// SPDX-License-Identifier: GPL-3.0-or-later
// window.crackle: what tests and measurements read of the page. Nothing in the page uses it.

import type {Viewer} from './viewer';

export function expose(viewer: Viewer): void {
    const {stage} = viewer.picture;
    Object.defineProperty(window, 'crackle', {value: Object.freeze({
        /// Each test on the screen: name, number of its frame, time.
        shown: () => [...viewer.picture.shown.values()].map(({view, frame}) => ({test: view.test.name, frame: frame.index, time: frame.time})),
        moment: () => viewer.clock.moment,
        playing: () => viewer.clock.playing,
        settings: () => structuredClone(viewer.settings),
        picked: () => viewer.picked && {test: viewer.picked.view.test.name, id: viewer.picked.view.test.cells.id[viewer.picked.cell]},
        zoom: () => ({...stage.panZoom}),
        settled: () => viewer.scaled(),
        /// Where a particle of a test is on the page, CSS pixels.
        place: (name: string, id: number) => viewer.placeOf(name, id),
        /// Draws as while moving, and waits until the picture stands.
        draw: () => {
            stage.drawMoving();
            stage.finish();
        },
    })});
}
