// SPDX-License-Identifier: GPL-3.0-or-later
// The page's script is compressed like its data, to a third of its size. Only this part is plain: it unpacks the rest and runs
// it.

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
