// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks: elements of the page that contain a zlib stream in base64. Block 0 of each test precedes the script. All other
// blocks follow it, so that the first picture need not wait for them; they are awaited when needed.

type WithBase64 = typeof Uint8Array & {fromBase64?: (text: string) => Uint8Array<ArrayBuffer>};

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
    const decode = (Uint8Array as WithBase64).fromBase64;
    if (decode) return decode.call(Uint8Array, base64);
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let at = 0; at < text.length; ++at) bytes[at] = text.charCodeAt(at);
    return bytes;
}

/// Resolves to the element once the parser has passed its end. Before that, its text may be incomplete.
async function complete(id: string): Promise<HTMLElement> {
    for (;;) {
        const parsed = document.readyState !== 'loading';
        const element = document.getElementById(id);
        if (element && (parsed || element.nextSibling)) return element;
        if (parsed) throw new Error(`the page does not contain its block '${id}'`);
        await new Promise((resume) => setTimeout(resume, 20));
    }
}

export function unpacked(text: string): ReadableStream<Uint8Array<ArrayBuffer>> {
    return new Blob([bytesOf(text.trim())]).stream().pipeThrough(new DecompressionStream('deflate'));
}

export async function readBlock(test: number, block: number): Promise<ArrayBuffer> {
    const element = await complete(`crackle-${test}-${block}`);
    return new Response(unpacked(element.textContent)).arrayBuffer();
}
