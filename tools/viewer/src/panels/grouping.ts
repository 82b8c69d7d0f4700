// SPDX-License-Identifier: GPL-3.0-or-later
// Which tests share a panel, what each is called there, and how its curve looks.

import type {CurvedTest, TestData} from '../data/report';

export type View = 'kind' | 'specimen' | 'test';

/// How one test appears wherever it is shown.
export interface Styled<Test extends TestData = TestData> {
    test: Test;
    colour: number; // index into Theme.series
    label: string; // full name, unique in the report
}

export interface Member extends Styled<CurvedTest> {
    shortLabel: string; // name inside its panel
    dashed: boolean;
}

export interface Panel {
    title: string;
    members: Member[];
}

const specimenOrder = ['circles', 'delaunay', 'voronoi'];
const kindOrder = ['tension', 'compression'];
const specimenNames: Record<string, string> = {circles: 'Circles', delaunay: 'Delaunay', voronoi: 'Voronoi'};

export function capitalised(text: string): string {
    return text.charAt(0).toUpperCase() + text.slice(1);
}

export function specimenName(test: TestData): string {
    return specimenNames[test.specimen] ?? capitalised(test.specimen);
}

function unique(values: string[]): string[] {
    return [...new Set(values)];
}

function ordered(values: string[], order: string[]): string[] {
    const rank = (value: string) => (order.includes(value) ? order.indexOf(value) : order.length);
    return unique(values).sort((a, b) => rank(a) - rank(b));
}

/// Tests named by specimen and kind where that tells them apart (colour = specimen), else by folder (colour = test).
export function style(tests: TestData[]): Styled[] {
    const name = (test: TestData) => `${specimenName(test)}, ${test.kind}`;
    const tellsApart = unique(tests.map(name)).length === tests.length && tests.every((test) => test.curve);
    const specimens = ordered(tests.map((test) => test.specimen), specimenOrder);
    const folders = unique(tests.map((test) => test.name));
    return tests.map((test, index) => {
        if (tellsApart) return {test, colour: specimens.indexOf(test.specimen), label: name(test)};
        const label = folders.length === tests.length ? test.name : `${test.name} (${index + 1})`;
        return {test, colour: index, label};
    });
}

export function viewsFor(tests: TestData[]): View[] {
    const kinds = unique(tests.map((test) => test.kind)).length;
    const specimens = unique(tests.map((test) => test.specimen)).length;
    const views: View[] = ['kind'];
    if (specimens > 1 && kinds > 1) views.push('specimen');
    if (tests.length > 1 && tests.length > kinds) views.push('test');
    return views;
}

function shortLabel(panelView: View, styled: Styled): string {
    const named = styled.label !== styled.test.name && !styled.label.startsWith(`${styled.test.name} (`);
    if (!named) return styled.label;
    return panelView === 'kind' ? specimenName(styled.test) : capitalised(styled.test.kind);
}

export function panels(styled: Styled<CurvedTest>[], view: View): Panel[] {
    if (view === 'test') {
        return styled.map((one) => ({title: one.label, members: [{...one, shortLabel: shortLabel('specimen', one), dashed: false}]}));
    }
    const keyOf = (one: Styled) => (view === 'kind' ? one.test.kind : one.test.specimen);
    const keys = ordered(styled.map(keyOf), view === 'kind' ? kindOrder : specimenOrder);
    return keys.map((key) => {
        const members = styled.filter((one) => keyOf(one) === key);
        const mixed = unique(members.map((one) => one.test.kind)).length > 1;
        return {
            title: view === 'kind' ? capitalised(key) : specimenName(members[0]!.test),
            members: members.map((one) => ({
                ...one,
                shortLabel: shortLabel(view, one),
                dashed: mixed && one.test.kind === 'tension',
            })),
        };
    });
}

/// Tests sorted by kind, then specimen (the table's columns), or by specimen, then kind (the rows of drawings).
export function sortedBy<Test extends TestData>(first: 'kind' | 'specimen', styled: Styled<Test>[]): Styled<Test>[] {
    const rank = (order: string[], value: string) => (order.includes(value) ? order.indexOf(value) : order.length);
    const kindRank = (one: Styled) => rank(kindOrder, one.test.kind);
    const specimenRank = (one: Styled) => rank(specimenOrder, one.test.specimen);
    return styled
        .map((one, index) => ({one, index}))
        .sort((a, b) => {
            const byKind = kindRank(a.one) - kindRank(b.one);
            const bySpecimen = specimenRank(a.one) - specimenRank(b.one);
            return (first === 'kind' ? byKind || bySpecimen : bySpecimen || byKind) || a.index - b.index;
        })
        .map(({one}) => one);
}

export function withCurve(styled: Styled[]): Styled<CurvedTest>[] {
    return styled.filter((one): one is Styled<CurvedTest> => one.test.curve !== undefined);
}
