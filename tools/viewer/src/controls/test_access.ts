// SPDX-License-Identifier: GPL-3.0-or-later
// window.crackle: access to the viewer's state for browser tests and measurements. The page itself does not use it.

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
        /// Position of a particle of a test on the page, CSS pixels.
        place: (name: string, id: number) => viewer.placeOf(name, id),
        /// Draws as during motion, and waits until the picture is finished.
        draw: () => {
            stage.drawMoving();
            stage.finish();
        },
    })});
}
