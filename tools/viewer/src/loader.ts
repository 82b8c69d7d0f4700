// SPDX-License-Identifier: GPL-3.0-or-later
// Decompresses the page's script and runs it. The script is compressed like the data, to a third of its size.

import {unpacked} from './data/blocks';

async function load(): Promise<void> {
    const script = document.createElement('script');
    script.textContent = await new Response(unpacked(document.getElementById('crackle-script')!.textContent)).text();
    document.head.append(script);
}

load().catch((error: unknown) => {
    document.getElementById('page')!.textContent = 'This page cannot be shown; it needs Chrome or Edge 100, Firefox 113, Safari 16.4 '
        + `or later: ${String(error)}`;
});
