// SPDX-License-Identifier: GPL-3.0-or-later
// Saves the view as PNG, SVG, animated GIF (gifenc), or video if the browser can record one, or copies it to the clipboard.

import {applyPalette, GIFEncoder, quantize} from 'gifenc';

import {element, saveFile, svgText} from '../elements/dom';
import type {Viewer} from './viewer';

const gifWidth = 800; // px, largest width
export const gifFrames = 200; // largest number of frames
const frameTime = 70; // ms per frame

type Report = (text: string) => void;

const nameOf = (viewer: Viewer): string => (viewer.chosen.length === 1 ? viewer.chosen[0]!.test.name : 'tests');

async function pngOf(viewer: Viewer): Promise<Blob> {
    await viewer.settled();
    const picture = viewer.picture.compose(viewer.picture.stage.stillRatio());
    const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, 'image/png'));
    if (!blob) throw new Error('the browser could not convert the picture to PNG');
    return blob;
}

export async function savePng(viewer: Viewer): Promise<void> {
    saveFile(`${nameOf(viewer)}.png`, 'image/png', await pngOf(viewer));
}

/// Whether the browser lets this page copy pictures to the clipboard. Some allow this only for pages loaded over https.
export const canCopy = (): boolean => typeof ClipboardItem !== 'undefined' && navigator.clipboard !== undefined;

/// @return message for the reader
export async function copyPng(viewer: Viewer): Promise<string> {
    // The item is given a promise, since browsers require write() to be called directly in the click handler.
    await navigator.clipboard.write([new ClipboardItem({'image/png': pngOf(viewer)})]);
    return 'Copied to the clipboard';
}

export function saveSvg(viewer: Viewer): void {
    saveFile(`${nameOf(viewer)}.svg`, 'image/svg+xml', svgText(viewer.picture.asSvg()));
}

/// Shows at most `most` frames and calls `record` for each, then resets the clock.
async function film(viewer: Viewer, most: number, report: Report, record: () => Promise<void>): Promise<void> {
    const {clock} = viewer, start = clock.index;
    clock.pause();
    const count = Math.min(clock.count, most);
    try {
        for (let at = 0; at < count; ++at) {
            // Moments are evenly spaced and include the first and the last one.
            const index = count > 1 ? Math.round(at * (clock.count - 1) / (count - 1)) : 0;
            clock.go(index);
            await viewer.settled();
            report(`Frame ${index + 1} of ${clock.count}`);
            await record();
        }
    } finally {
        clock.go(start);
    }
}

export async function saveGif(viewer: Viewer, report: Report): Promise<void> {
    await viewer.scaled();
    const {picture} = viewer, ratio = Math.min(1, gifWidth / picture.width);
    const encoder = GIFEncoder(), canvas = element('canvas');
    await film(viewer, gifFrames, report, async () => {
        picture.compose(ratio, canvas);
        const {data} = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
        const palette = quantize(data, 256);
        encoder.writeFrame(applyPalette(data, palette), canvas.width, canvas.height, {palette, delay: frameTime});
        await new Promise((resume) => setTimeout(resume));
    });
    encoder.finish();
    saveFile(`${nameOf(viewer)}.gif`, 'image/gif', encoder.bytes());
}

/// Type of the videos that this browser records; undefined if none.
export function videoType(): string | undefined {
    if (typeof MediaRecorder === 'undefined' || !('captureStream' in HTMLCanvasElement.prototype)) return undefined;
    return ['video/mp4;codecs=avc1', 'video/webm;codecs=vp9', 'video/webm'].find((type) => MediaRecorder.isTypeSupported(type));
}

export async function saveAnimation(viewer: Viewer, report: Report): Promise<void> {
    const type = videoType();
    if (!type) return;
    await viewer.scaled();
    const {picture} = viewer, canvas = picture.compose(1);
    const recorder = new MediaRecorder(canvas.captureStream(30), {mimeType: type, videoBitsPerSecond: 8e6});
    const parts: Blob[] = [];
    recorder.addEventListener('dataavailable', ({data}) => parts.push(data));
    const stopped = new Promise((resolve) => recorder.addEventListener('stop', resolve));
    const pause = (time: number) => new Promise((resume) => setTimeout(resume, time));
    recorder.start();
    try {
        await film(viewer, Infinity, report, async () => {
            picture.compose(1, canvas);
            await pause(frameTime / viewer.clock.speed);
        });
        await pause(300);
    } finally {
        recorder.stop();
    }
    await stopped;
    const [plainType] = type.split(';') as [string];
    saveFile(`${nameOf(viewer)}.${plainType.split('/')[1]}`, plainType, new Blob(parts));
}
