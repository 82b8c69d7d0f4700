// SPDX-License-Identifier: GPL-3.0-or-later
// Keyboard control of the viewer. In a report, keys work while the viewer has the focus; on a page of `crackle view`, always.

import {layerKeys} from './keys';
import type {Viewer} from './viewer';
import type {ViewerControls} from './viewer_controls';

export function listen(viewer: Viewer, controls: ViewerControls, within: HTMLElement, everywhere: boolean): void {
    document.addEventListener('keydown', (event) => {
        const target = event.target as HTMLElement;
        if (copies(event) && (everywhere || within.contains(target)) && !controls.help.open && controls.copy()) event.preventDefault();
        if (event.ctrlKey || event.metaKey || event.altKey || controls.help.open) return;
        if (!everywhere && !within.contains(target)) return;
        if (target.matches('select, input[type="text"]')) return;
        // A focused slider handles arrow keys itself, and a focused button the space bar.
        if (target.matches('input[type="range"]') && /^(Arrow|Home|End|Page)/.test(event.key)) return;
        if (target.matches('button, summary, input[type="checkbox"]') && event.key === ' ') return;
        if (act(event, viewer, controls)) event.preventDefault();
    });
}

/// Whether a key event is Ctrl C without selected text to copy.
function copies(event: KeyboardEvent): boolean {
    const target = event.target as HTMLElement;
    return (event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey && event.key === 'c' && getSelection()?.isCollapsed !== false && !target.matches('input[type="text"]');
}

function act(event: KeyboardEvent, viewer: Viewer, controls: ViewerControls): boolean {
    const {clock, settings, navigation} = viewer;
    const far = event.shiftKey ? 10 : 1;
    switch (event.key) {
        case ' ':
            if (clock.playing) clock.pause();
            else clock.play();
            return true;
        case 'ArrowRight': clock.step(far); return true;
        case 'ArrowLeft': clock.step(-far); return true;
        case 'Home': clock.step(-clock.count); return true;
        case 'End': clock.step(clock.count); return true;
        case '+': case '=': navigation.scaleBy(1.25); return true;
        case '-': navigation.scaleBy(0.8); return true;
        case '0': navigation.fit(); return true;
        case '?': controls.help.showModal(); return true;
        case 'Escape': viewer.pick(undefined); return true;
        case 'm': settings.magnification = {1: 10, 10: 100}[settings.magnification] ?? 1; break;
        case 'c': case 'C': {
            const keys = viewer.quantities.map(({key}) => key), by = event.key === 'c' ? 1 : keys.length - 1;
            settings.quantity = keys[(keys.indexOf(viewer.quantity.key) + by) % keys.length]!;
            break;
        }
        default: {
            const layer = layerKeys[event.key];
            if (!layer) return false;
            settings.layers[layer] = !settings.layers[layer];
        }
    }
    controls.build();
    viewer.refresh();
    return true;
}
