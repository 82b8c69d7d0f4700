// SPDX-License-Identifier: GPL-3.0-or-later
// Creates HTML and SVG elements in one call. Text is never inserted as markup, because titles and names come from users' files.

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

/// Downloads a file made in the page.
export function saveFile(name: string, type: string, content: BlobPart): void {
    const address = URL.createObjectURL(new Blob([content], {type}));
    element('a', {href: address, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
}

export function svgText(svg: SVGElement): string {
    return new XMLSerializer().serializeToString(svg);
}

export function button(content: Child, title: string, onClick: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
    const made = element('button', {type: 'button', title, ...attributes}, content);
    made.addEventListener('click', onClick);
    return made;
}

export function checkbox(label: string, checked: boolean, onChange: (checked: boolean) => void, attributes: Record<string, string> = {}): HTMLLabelElement {
    const box = element('input', {type: 'checkbox', ...attributes});
    box.checked = checked;
    box.addEventListener('change', () => onChange(box.checked));
    return element('label', {class: 'check'}, box, label);
}

/// @param ownLine  whether the list is below its label and as wide as its column, for long names
export function select<T extends string>(
    label: string, options: readonly {value: T; text: string}[], chosen: T, onChange: (value: T) => void, attributes: Record<string, string> = {}, ownLine = false,
): HTMLLabelElement {
    const list = element('select', attributes, ...options.map(({value, text}) => element('option', {value}, text)));
    list.value = chosen;
    const name = () => { list.title = attributes['title'] ?? list.selectedOptions[0]?.text ?? ''; };
    name();
    list.addEventListener('change', () => {
        name();
        onChange(list.value as T);
    });
    return element('label', {class: ownLine ? 'select own-line' : 'select'}, element('span', {}, label), list);
}

/// A row of buttons of which one is selected.
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
