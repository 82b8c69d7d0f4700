// SPDX-License-Identifier: GPL-3.0-or-later
// Groups tests into panels of curves, with the name and line style of each test in its panel.

import {largestOf, type CurvedTest, type MeasuredCurve, type TestData} from '../data/report';
import {capitalised, kindOrder, ordered, specimenName, specimenOrder, unique, type LabelledTest} from '../data/test_labels';

export type View = 'kind' | 'specimen' | 'test';

export interface Member extends LabelledTest<CurvedTest> {
    shortLabel: string; // name inside its panel
    dashed: boolean;
}

export interface Panel {
    title: string;
    members: Member[];
    measured?: MeasuredCurve | undefined;
}

export function viewsFor(tests: TestData[]): View[] {
    const kinds = unique(tests.map((test) => test.kind)).length;
    const specimens = unique(tests.map((test) => test.specimen)).length;
    const views: View[] = ['kind'];
    if (specimens > 1 && kinds > 1) views.push('specimen');
    if (tests.length > 1 && tests.length > kinds) views.push('test');
    return views;
}

function shortLabel(panelView: View, labelled: LabelledTest): string {
    const named = labelled.label !== labelled.test.name;
    if (!named) return labelled.label;
    return panelView === 'kind' ? specimenName(labelled.test) : capitalised(labelled.test.kind);
}

export function panels(labelled: LabelledTest<CurvedTest>[], view: View): Panel[] {
    if (view === 'test') {
        return labelled.map((one) => ({title: one.label, members: [{...one, shortLabel: shortLabel('specimen', one), dashed: false}]}));
    }
    const keyOf = (one: LabelledTest) => (view === 'kind' ? one.test.kind : one.test.specimen);
    const keys = ordered(labelled.map(keyOf), view === 'kind' ? kindOrder : specimenOrder);
    return keys.flatMap((key) => {
        const members = labelled.filter((one) => keyOf(one) === key);
        const mixed = unique(members.map((one) => one.test.kind)).length > 1;
        const title = view === 'kind' ? capitalised(key) : specimenName(members[0]!.test);
        const panel = (name: string, those: LabelledTest<CurvedTest>[], dashed: boolean): Panel => ({title: name, members: those.map((one) => ({
            ...one,
            shortLabel: shortLabel(view, one),
            dashed: dashed && one.test.kind === 'tension',
        }))});
        if (!mixed || !hasSlivers(members)) return [panel(title, members, mixed)];
        return ordered(members.map((one) => one.test.kind), kindOrder)
            .map((kind) => panel(`${title}, ${kind}`, members.filter((one) => one.test.kind === kind), false));
    });
}

const leastStress = 0.25, leastStrain = 0.2; // smallest ratios between the largest values of the kinds

/// Whether the curves of one kind of test would be hard to see on the scales of the other kind. They then get separate panels.
function hasSlivers(members: readonly LabelledTest<CurvedTest>[]): boolean {
    const largest = (kind: string, name: 'stress' | 'strain') => members.filter((one) => one.test.kind === kind)
        .reduce((most, {test}) => Math.max(most, largestOf(test.curve[name])), 0);
    const share = (name: 'stress' | 'strain') => {
        const all = unique(members.map((one) => one.test.kind)).map((kind) => largest(kind, name)).filter((value) => value > 0);
        return all.length === 0 ? 1 : Math.min(...all) / Math.max(...all);
    };
    return share('stress') < leastStress || share('strain') < leastStrain;
}
