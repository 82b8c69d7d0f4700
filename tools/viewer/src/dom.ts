// SPDX-License-Identifier: GPL-3.0-or-later
// Elements in one call. Text always goes in as text, never as markup: titles and names come from users' files.

type Child = Node | string;

export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Record<string, string> = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
}

const svgNamespace = 'http://www.w3.org/2000/svg';

export function svgElement(tag: string, attributes: Record<string, string | number> = {}, ...children: Child[]): SVGElement {
    const made = document.createElementNS(svgNamespace, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
    made.append(...children);
    return made;
}

/// Hands the reader a file made in the page.
export function saveFile(name: string, type: string, text: string): void {
    const address = URL.createObjectURL(new Blob([text], {type}));
    element('a', {href: address, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/// A row of buttons of which one is chosen.
export function choice<T extends string>(
    label: string, options: readonly {value: T; text: string}[], chosen: T, onChange: (value: T) => void,
): HTMLElement {
    const group = element('div', {class: 'choice', role: 'group', 'aria-label': label}, element('span', {}, label));
    for (const option of options) {
        const button = element('button', {type: 'button', 'aria-pressed': String(option.value === chosen), 'data-value': option.value},
            option.text);
        button.addEventListener('click', () => {
            for (const other of group.querySelectorAll('button')) other.setAttribute('aria-pressed', String(other === button));
            onChange(option.value);
        });
        group.append(button);
    }
    return group;
}
