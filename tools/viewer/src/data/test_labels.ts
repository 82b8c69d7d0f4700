// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the tests, the colours of their curves, and the order in which they are listed.

import type {CurvedTest, TestData} from './report';

/// A test with the label and colour used wherever it is shown.
export interface LabelledTest<Test extends TestData = TestData> {
    test: Test;
    colour: number; // index into Theme.series
    label: string; // full name, unique in the report
}

export const specimenOrder = ['circles', 'delaunay', 'voronoi'];
export const kindOrder = ['tension', 'compression', 'biaxial', 'brazilian', 'bending', 'semi-circular bend', 'direct shear'];
const specimenNames: Record<string, string> = {circles: 'Circles', delaunay: 'Delaunay', voronoi: 'Voronoi'};

export function capitalised(text: string): string {
    return text.charAt(0).toUpperCase() + text.slice(1);
}

export function specimenName(test: TestData): string {
    return specimenNames[test.specimen] ?? capitalised(test.specimen);
}

export function unique<T>(values: readonly T[]): T[] {
    return [...new Set(values)];
}

/// The distinct values: first those in `order`, then all others.
export function ordered(values: string[], order: string[]): string[] {
    const rank = (value: string) => (order.includes(value) ? order.indexOf(value) : order.length);
    return unique(values).sort((a, b) => rank(a) - rank(b));
}

/// Labels tests by specimen and kind if these labels are unique (one colour per specimen), otherwise by their unique names on
/// the page (one colour per test).
export function labelTests(tests: TestData[]): LabelledTest[] {
    const name = (test: TestData) => `${specimenName(test)}, ${test.kind}`;
    const namesUnique = unique(tests.map(name)).length === tests.length && tests.every((test) => test.curve);
    const specimens = ordered(tests.map((test) => test.specimen), specimenOrder);
    return tests.map((test, index) => {
        if (namesUnique) return {test, colour: specimens.indexOf(test.specimen), label: name(test)};
        return {test, colour: index, label: test.name};
    });
}

/// Tests sorted by kind, then specimen (the table's columns), or by specimen, then kind (the rows of drawings).
export function sortedBy<Test extends TestData>(first: 'kind' | 'specimen', labelled: LabelledTest<Test>[]): LabelledTest<Test>[] {
    const rank = (order: string[], value: string) => (order.includes(value) ? order.indexOf(value) : order.length);
    const kindRank = (one: LabelledTest) => rank(kindOrder, one.test.kind);
    const specimenRank = (one: LabelledTest) => rank(specimenOrder, one.test.specimen);
    return labelled
        .map((one, index) => ({one, index}))
        .sort((a, b) => {
            const byKind = kindRank(a.one) - kindRank(b.one);
            const bySpecimen = specimenRank(a.one) - specimenRank(b.one);
            return (first === 'kind' ? byKind || bySpecimen : bySpecimen || byKind) || a.index - b.index;
        })
        .map(({one}) => one);
}

export function withCurve(labelled: LabelledTest[]): LabelledTest<CurvedTest>[] {
    return labelled.filter((one): one is LabelledTest<CurvedTest> => one.test.curve !== undefined);
}
