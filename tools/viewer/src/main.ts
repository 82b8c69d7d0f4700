// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the page: title, curves, summaries, drawings; draws the figures anew when theme, view, size or paper change.

import type {ECharts} from 'echarts/core';

import {drawPanel, panelAsSvg} from './curves';
import {readReport, type Report} from './data';
import {choice, element, saveFile} from './dom';
import {drawings, magnifications} from './drawings';
import {panels, style, viewsFor, type Styled, type View} from './grouping';
import {summaryTable} from './table';
import {currentTheme} from './theme';

const viewNames: Record<View, string> = {kind: 'Kind of test', specimen: 'Specimen', test: 'Each test'};

interface State {
    view: View;
    magnification: number;
}

class Page {
    private charts: ECharts[] = [];
    private readonly state: State = {view: 'kind', magnification: 1};
    private readonly tests: Styled[];
    private readonly panelHolder = element('div', {class: 'panels'});
    private readonly cardHolder = element('div', {class: 'cards'});

    constructor(private readonly report: Report, private readonly root: HTMLElement) {
        this.tests = style(report.tests);
        this.layOut();
        this.draw();
        this.watch();
    }

    private layOut(): void {
        document.title = this.report.title;
        const views = viewsFor(this.report.tests).map((value) => ({value, text: viewNames[value]}));
        const unfinished = this.tests.filter(({test}) => !test.failed);
        this.root.replaceChildren(
            element('header', {}, element('div', {}, element('h1', {}, this.report.title), element('p', {class: 'about'}, this.about())), this.themeButton()),
            ...(unfinished.length === 0 ? [] : [element('p', {class: 'notice warning', role: 'note'},
                `Not failed: ${unfinished.map(({label, test}) => label + endedBy(test.summary['ended_by'])).join('; ')}. What is shown as the peak of ${unfinished.length === 1 ? 'this test' : 'these tests'} is the peak so far.`)]),
            element('section', {id: 'curves'},
                element('h2', {}, 'Stress, strain and bond breaks'),
                element('div', {class: 'controls'}, ...(views.length > 1 ? [choice('One panel for each', views, this.state.view, (value) => {
                    this.state.view = value;
                    this.drawCurves();
                })] : []), element('span', {class: 'hint'}, 'Shift and wheel zoom the strain axis, dragging moves it, a double click shows all.')),
                this.panelHolder,
                this.curveCaption()),
            element('section', {id: 'summary'}, element('h2', {}, 'Summary'), summaryTable(this.tests)),
            element('section', {id: 'specimens'},
                element('h2', {}, 'Specimens and broken bonds'),
                element('div', {class: 'controls'}, choice('Displacements', magnifications.map((value) => ({value: String(value), text: `×${value}`})), '1', (value) => {
                    this.state.magnification = Number(value);
                    this.drawSpecimens();
                }), this.modeLegend()),
                this.cardHolder),
            element('footer', {}, `Made by crackle ${this.report.version}. Strictly 2D: stresses and moduli are forces per unit length, N/m.`));
    }

    private about(): string {
        const count = this.report.tests.length;
        return `${count} virtual ${count === 1 ? 'test' : 'tests'}: ${this.tests.map(({label}) => label).join(' · ')}`;
    }

    private curveCaption(): HTMLElement {
        return element('p', {class: 'caption'},
            'Stress is the mean of the two platens’ forces over the initial width, strain the platen displacement over the initial height, both positive in ',
            'the test’s own sense. Beneath each: bonds broken in each interval of strain, by mode (', mark('tension'), ' tension, ', mark('shear'), ' shear), ',
            'and bonds broken so far as a line.');
    }

    private modeLegend(): HTMLElement {
        return element('span', {class: 'legend'}, 'Broken in ', mark('tension'), ' tension, ', mark('shear'),
            ' shear; dotted: some bonded points of the interface still hold.');
    }

    private themeButton(): HTMLElement {
        const button = element('button', {type: 'button', class: 'theme'}, 'Light / dark');
        button.addEventListener('click', () => {
            document.documentElement.dataset['theme'] = currentTheme().name === 'dark' ? 'light' : 'dark';
            this.draw();
        });
        return button;
    }

    private draw(): void {
        const theme = currentTheme();
        document.documentElement.dataset['shown'] = theme.name;
        document.documentElement.style.setProperty('--tension', theme.tension);
        document.documentElement.style.setProperty('--shear', theme.shear);
        this.drawCurves();
        this.drawSpecimens();
    }

    private drawCurves(): void {
        for (const chart of this.charts) chart.dispose();
        const theme = currentTheme();
        const shown = panels(this.tests, this.state.view);
        this.panelHolder.classList.toggle('single', shown.length === 1);
        const holders = shown.map((panel) => {
            const figure = element('div', {class: 'panel'});
            const save = element('button', {type: 'button', class: 'save', title: 'Save this figure as SVG'}, 'SVG');
            const holder = element('div', {class: 'frame', 'data-panel': panel.title}, figure, save);
            return {panel, figure, save, holder};
        });
        this.panelHolder.replaceChildren(...holders.map(({holder}) => holder));
        this.charts = holders.map(({panel, figure, save}) => {
            const chart = drawPanel(figure, panel, theme);
            save.addEventListener('click', () => saveFile(`${panel.title.toLowerCase()}.svg`, 'image/svg+xml', panelAsSvg(chart)));
            return chart;
        });
    }

    private drawSpecimens(): void {
        this.cardHolder.replaceChildren(...drawings(this.tests, this.state.magnification, currentTheme()));
    }

    private watch(): void {
        new ResizeObserver(() => this.charts.forEach((chart) => chart.resize())).observe(this.panelHolder);
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
        const paper = (printing: boolean) => {
            if (printing) document.documentElement.dataset['printing'] = 'true';
            else delete document.documentElement.dataset['printing'];
            this.draw();
        };
        addEventListener('beforeprint', () => paper(true));
        addEventListener('afterprint', () => paper(false));
    }
}

function endedBy(reason: unknown): string {
    return typeof reason === 'string' && reason !== '' ? ` (ended by ${reason})` : '';
}

function mark(mode: 'tension' | 'shear'): HTMLElement {
    return element('i', {class: `mark ${mode}`});
}

async function start(): Promise<void> {
    const root = document.getElementById('page')!;
    try {
        new Page(await readReport(document.getElementById('crackle-data')), root);
        document.documentElement.dataset['ready'] = 'true';
    } catch (error) {
        root.replaceChildren(element('p', {class: 'notice warning'}, `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
        throw error;
    }
}

void start();
