// SPDX-License-Identifier: GPL-3.0-or-later
// What a report states first: strength with its error, stiffness, onset of cracking, and whether the test is valid.

import {inArea, numberOf, peakOf, stressUnitOf, type CurvedTest, type TestData} from '../data/report';
import type {LabelledTest} from '../data/test_labels';
import {element} from '../elements/dom';
import {missing, quantity, significant, strain} from '../quantities/units';

const unmeasured = 'error not measured (--verify)';

interface Finding {
    name: string;
    value: string;
    note: string;
}

/// Whether a test is valid for its kind; `reasons` are the conditions that it does not meet. Undefined if its kind has no conditions.
export function verdictOf(test: TestData): {valid: boolean | undefined; reasons: string[]} | undefined {
    const claims = test.summary['validity'];
    if (!Array.isArray(claims)) return undefined;
    const broken = (claims as {holds: boolean | null; sentence?: string}[]).filter(({holds}) => holds === false);
    if (broken.length > 0) return {valid: false, reasons: broken.map(({sentence}) => sentence ?? '')};
    return {valid: test.summary['valid'] === true ? true : undefined, reasons: []};
}

/// Relative numerical error of the peak stress, from the companion tests of `crackle test --verify`.
function statedError(test: CurvedTest): number | undefined {
    const all = test.summary['numerical_errors'] as Record<string, Record<string, unknown>> | undefined;
    const stated = all?.['peak_stress']?.['stated'];
    return typeof stated === 'number' ? stated : undefined;
}

function strengthOf(test: CurvedTest): Finding & {error: string} {
    const {stress, strain: at} = peakOf(test), relative = statedError(test);
    const thickness = inArea(test) ? undefined : numberOf(test.summary, 'out_of_plane_thickness');
    const error = relative === undefined ? missing : `± ${significant(100 * relative, 2)} %`;
    const notes = [
        ...(thickness === undefined || stress === undefined ? [] : [quantity(stress / thickness, 'Pa')]),
        ...(at === undefined ? [] : [`at a strain of ${strain(at)}`]),
        relative === undefined ? unmeasured : error,
    ];
    return {name: test.failed ? 'Strength' : 'Largest stress so far', value: quantity(stress, stressUnitOf(test)), note: notes.join(', '), error};
}

/// A stress of the test as a finding, with its share of the peak; none if the test does not have it.
function shareOfPeak(test: CurvedTest, name: string, key: string): Finding[] {
    const value = numberOf(test.summary, key), peak = peakOf(test).stress;
    if (value === undefined) return [];
    return [{name, value: quantity(value, stressUnitOf(test)), note: peak ? `${significant(100 * value / peak, 2)} % of the peak` : ''}];
}

/// The fracture toughness of a notched specimen.
function toughnessOf(test: CurvedTest): Finding[] {
    const value = numberOf(test.summary, test.failed ? 'fracture_toughness' : 'fracture_toughness_so_far');
    const name = test.failed ? 'Fracture toughness' : 'Stress intensity so far';
    return value === undefined ? [] : [{name, value: quantity(value, `${stressUnitOf(test)} √m`), note: 'K_I at the largest load'}];
}

function findingsOf(test: CurvedTest): Finding[] {
    const modulus = numberOf(test.summary, 'youngs_modulus'), nominal = numberOf(test.summary, 'nominal_modulus');
    const ratio = numberOf(test.summary, 'poissons_ratio');
    return [
        ...toughnessOf(test),
        strengthOf(test),
        ...(modulus !== undefined ? [{name: 'Young’s modulus', value: quantity(modulus, stressUnitOf(test)), note: ratio === undefined ? '' : `Poisson’s ratio ${significant(ratio)}`}]
            : nominal !== undefined ? [{name: 'Nominal modulus', value: quantity(nominal, stressUnitOf(test)), note: 'stress over strain of this kind of test'}] : []),
        ...shareOfPeak(test, 'Crack initiation σci', 'crack_initiation_stress'),
        ...shareOfPeak(test, 'Crack damage σcd', 'crack_damage_stress'),
    ];
}

function verdictText({valid, reasons}: {valid: boolean | undefined; reasons: string[]}, [yes, no, unknown]: readonly [string, string, string]): (HTMLElement | string)[] {
    const text = valid === undefined ? unknown : valid ? yes : no;
    return [element('b', {}, text), reasons.length === 0 ? '' : `: ${reasons.join('; ')}`];
}

/// The findings of the only test of a report, in large numbers.
function findingsAlone(test: CurvedTest): HTMLElement[] {
    const found = verdictOf(test);
    return [
        element('dl', {}, ...findingsOf(test).map(({name, value, note}) => element('div', {},
            element('dt', {}, name), element('dd', {class: 'value'}, value), element('dd', {class: 'note'}, note)))),
        ...(found ? [element('p', {class: found.valid === false ? 'verdict warning' : 'verdict'},
            ...verdictText(found, ['Valid test', 'Not a valid test', 'Validity not known yet']))] : []),
    ];
}

/// The findings of several tests, a row each.
function findingsTable(tests: readonly LabelledTest<CurvedTest>[]): HTMLElement[] {
    const rows = tests.map(({label, test}) => {
        const found = verdictOf(test), {value, error} = strengthOf(test), {strain: at} = peakOf(test);
        const modulus = numberOf(test.summary, 'youngs_modulus') ?? numberOf(test.summary, 'nominal_modulus');
        return element('tr', {'data-test': test.name},
            element('th', {scope: 'row'}, label),
            element('td', {class: 'value'}, value + (test.failed ? '' : ' so far')), element('td', {}, error), element('td', {}, strain(at)),
            element('td', {}, quantity(modulus, stressUnitOf(test))), element('td', {}, significant(numberOf(test.summary, 'poissons_ratio'))),
            element('td', {class: found?.valid === false ? 'verdict invalid' : 'verdict'}, ...(found ? verdictText(found, ['yes', 'no', 'not known yet']) : [missing])));
    });
    const heads = ['', 'Strength', 'Error', 'Strain there', 'Modulus', 'Poisson’s ratio', 'Valid'];
    const head = element('thead', {}, element('tr', {}, ...heads.map((name) => element('th', {scope: 'col', class: name === 'Valid' ? 'verdict' : ''}, name))));
    const measured = tests.some(({test}) => statedError(test) !== undefined);
    return [element('div', {class: 'scroll'}, element('table', {class: 'summary'}, head, element('tbody', {}, ...rows))),
        ...(measured ? [] : [element('p', {class: 'caption'}, 'Errors of the strength were not measured: run the tests with ', element('code', {}, '--verify'), '.')])];
}

/// What the tests of a report have found.
export function findings(tests: readonly LabelledTest<CurvedTest>[]): HTMLElement[] {
    return tests.length === 1 ? findingsAlone(tests[0]!.test) : findingsTable(tests);
}
