// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of the figures in light and dark. Curves are ink, teal or purple. Only the two breakage modes are blue
// and vermilion (Okabe and Ito's pair, distinguishable with any colour vision), so each colour has one meaning.

export interface Theme {
    name: 'light' | 'dark';
    background: string;
    ink: string; // axes, text
    muted: string; // secondary text, ticks
    grid: string;
    grain: string; // fill of particles
    grainEdge: string;
    platen: string;
    tension: string; // breakage modes
    shear: string;
    compressive: string; // contact forces
    tensile: string;
    bond: string;
    slid: string; // bonds that have slid, and slips
    picked: string; // outline of the picked particle
    series: readonly string[]; // curves
    overlaid: readonly [string, string]; // two tests in one picture
}

const light: Theme = {
    name: 'light',
    background: '#ffffff',
    ink: '#1d2125',
    muted: '#5b636b',
    grid: '#e6e8ea',
    grain: '#e3e0d9',
    grainEdge: '#a39d91',
    platen: '#4b5259',
    tension: '#0072b2',
    shear: '#d55e00',
    compressive: '#1d2125',
    tensile: '#cc3d8f',
    bond: '#7a8188',
    slid: '#009e73',
    picked: '#d4006a',
    series: ['#22262a', '#00896b', '#aa3377', '#8a6d00', '#6a51a3', '#737a80', '#a6611a', '#33a3c2'],
    overlaid: ['#00896b', '#aa3377'],
};

const dark: Theme = {
    name: 'dark',
    background: '#15181b',
    ink: '#e4e7ea',
    muted: '#9aa3ab',
    grid: '#2b3035',
    grain: '#3a3d3f',
    grainEdge: '#6c7174',
    platen: '#b4bac0',
    tension: '#56b4e9',
    shear: '#ff8c3a',
    compressive: '#f2f4f5',
    tensile: '#ff7ac2',
    bond: '#8d959c',
    slid: '#35c9a4',
    picked: '#ff5fa8',
    series: ['#eceff1', '#35c9a4', '#e57cb8', '#e0c04c', '#b3a2e6', '#8f989f', '#d9a066', '#7cd3ea'],
    overlaid: ['#35c9a4', '#e57cb8'],
};

/// The theme that the reader has chosen, or else the browser's; always light for printing.
export function currentTheme(): Theme {
    const chosen = document.documentElement.dataset['theme'];
    if (document.documentElement.dataset['printing'] === 'true') return light;
    if (chosen === 'light') return light;
    if (chosen === 'dark') return dark;
    return matchMedia('(prefers-color-scheme: dark)').matches ? dark : light;
}
