// SPDX-License-Identifier: GPL-3.0-or-later
// The table of summaries, with a row for each quantity and a column for each test. All values in a row have the same unit.

import {inArea, numberOf, type TestData} from '../data/report';
import {capitalised, sortedBy, specimenName, type LabelledTest} from '../data/test_labels';
import {element} from '../elements/dom';
import {counted, missing, scaleFor, significant, strainFactor, strainUnit, unitOf} from '../quantities/units';
import {modeCounts} from './event_histogram';
import {verdictOf} from './findings';

type Read = (test: TestData) => number | undefined;

interface Row {
    name: string;
    note?: string; // tooltip
    cells: (tests: TestData[]) => {unit: string; values: (string | undefined)[]};
}

const key = (name: string): Read => (test) => numberOf(test.summary, name);
const either = (...names: string[]): Read => (test) => names.map((name) => numberOf(test.summary, name)).find((value) => value !== undefined);

/// A row of numbers in a unit, all with the same SI prefix.
function measured(name: string, unit: string, read: Read, note?: string): Row {
    return {
        name, ...(note ? {note} : {}),
        cells: (tests) => {
            const values = tests.map(read);
            const scale = scaleFor(values, unit);
            return {unit: unitOf(scale), values: values.map((value) => (value === undefined ? undefined : significant(value / scale.factor)))};
        },
    };
}

const where = (holds: (test: TestData) => boolean, read: Read): Read => (test) => (holds(test) ? read(test) : undefined);

/// Whether stresses can be converted to three dimensions, because the case gives a thickness.
const hasThickness = (test: TestData): boolean => !inArea(test) && numberOf(test.summary, 'out_of_plane_thickness') !== undefined;

/// Rows for a stress or modulus: in Pa for tests in area units, otherwise in N/m, and in Pa for tests with a thickness.
const inPlaneAndSpace = (name: string, inPlane: Read, inSpace: Read, note?: string): Row[] => [
    measured(name, 'Pa', where(inArea, inPlane), note),
    measured(name, 'N/m', where((test) => !inArea(test), inPlane), note),
    measured(`${name} over the thickness`, 'Pa', where(hasThickness, inSpace)),
];
const stress = (name: string, keys: readonly string[], note?: string): Row[] =>
    inPlaneAndSpace(name, either(...keys), either(...keys.map((one) => `${one}_pa`)), note);

/// Reads the largest stress if it is reached after the peak; undefined otherwise.
const later = (name: string): Read => (test) => {
    const [peak, largest] = [numberOf(test.summary, 'peak_stress'), numberOf(test.summary, 'largest_stress')];
    return peak !== undefined && largest !== undefined && largest > peak ? numberOf(test.summary, name) : undefined;
};

/// Whether the bond law has strengths of its own.
const hasStrengths = (test: TestData): boolean => numberOf(test.summary, 'mean_tensile_strength') !== undefined;

function plain(name: string, read: Read, note?: string): Row {
    return {name, ...(note ? {note} : {}), cells: (tests) => ({unit: '–', values: tests.map(read).map((value) => (value === undefined ? undefined : significant(value)))})};
}

function strains(name: string, read: Read, note?: string): Row {
    return {name, ...(note ? {note} : {}), cells: (tests) => ({unit: strainUnit, values: tests.map(read).map((value) => (value === undefined ? undefined : significant(value / strainFactor)))})};
}

function counts(name: string, read: Read, note?: string): Row {
    return {name, ...(note ? {note} : {}), cells: (tests) => ({unit: '–', values: tests.map(read).map((value) => (value === undefined ? undefined : counted(value)))})};
}

function percent(name: string, read: Read, note?: string): Row {
    return {name, ...(note ? {note} : {}), cells: (tests) => ({unit: '%', values: tests.map(read).map((value) => (value === undefined ? undefined : significant(value * 100, 2)))})};
}

function millions(name: string, read: Read): Row {
    return {name, cells: (tests) => ({unit: '10⁶/s', values: tests.map(read).map((value) => (value === undefined ? undefined : significant(value / 1e6)))})};
}

function words(name: string, read: (test: TestData) => unknown): Row {
    return {name, cells: (tests) => ({unit: '', values: tests.map(read).map((value) => (value === undefined || value === null ? undefined : String(value)))})};
}

const ratio = (part?: number, whole?: number): number | undefined => (part === undefined || whole === undefined || whole === 0 ? undefined : part / whole);

/// A number from a table in the summary.
function numberIn(test: TestData, table: string, name: string): number | undefined {
    const value = (test.summary[table] as Record<string, unknown> | null | undefined)?.[name];
    return typeof value === 'number' ? value : undefined;
}

function verdictText(test: TestData): string | undefined {
    const found = verdictOf(test);
    return found && (found.reasons.length > 0 ? `no: ${found.reasons.join('; ')}` : found.valid ? 'yes' : 'not known yet');
}

/// Row with a value for each unloading, in order.
function eachCycle(name: string, figure: string, factor: number, unit: string, note: string): Row {
    const read = (test: TestData): string | undefined => {
        const cycles = test.summary['cycles'];
        if (!Array.isArray(cycles) || cycles.length === 0) return undefined;
        return (cycles as Record<string, unknown>[]).map(({[figure]: value}) => (typeof value === 'number' ? significant(value * factor, 2) : missing)).join(', ');
    };
    return {name, note, cells: (tests) => ({unit, values: tests.map(read)})};
}

type Joint = Record<string, unknown> & {at_peak: Record<string, unknown> | null; at_end: Record<string, unknown>};

/// Row with a value for each joint set or [[trace]], in order.
function eachJoint(name: string, read: (joint: Joint) => unknown, factor: number, unit: string, note?: string): Row {
    const cell = (test: TestData): string | undefined => {
        const joints = test.summary['joints'];
        if (!Array.isArray(joints) || joints.length === 0) return undefined;
        const values = (joints as Joint[]).map(read);
        if (values.every((value) => value === null || value === undefined)) return undefined;
        return values.map((value) => (typeof value === 'number' ? significant(value * factor, 3) : typeof value === 'string' ? value : missing)).join(', ');
    };
    return {name, ...(note ? {note} : {}), cells: (tests) => ({unit, values: tests.map(cell)})};
}

const jointMotions = (['peak', 'end'] as const).flatMap((moment) => {
    const at = (figure: string) => (joint: Joint) => (moment === 'peak' ? joint.at_peak : joint.at_end)?.[figure];
    return [
        eachJoint(`Failed, at the ${moment}`, at('failed_share'), 100, '%', 'fraction of the bonded length: faces that have lost all their bonds'),
        eachJoint(`Mean opening, at the ${moment}`, at('opening'), 1e6, 'µm', 'since loading began, including the elastic deformation of the faces’ springs'),
        eachJoint(`Mean slip, at the ${moment}`, at('slip'), 1e6, 'µm', 'since loading began, including elastic deformation; positive if the far side moves to the left'),
        eachJoint(`Largest slip, at the ${moment}`, at('largest_slip'), 1e6, 'µm', 'slip of the face that has slipped most'),
    ];
});

/** Reads a part of the relative error stated for a number in the summary; undefined if it was not measured. */
function errorOf(number: string, part: string): Read {
    return (test) => {
        const all = test.summary['numerical_errors'] as Record<string, Record<string, unknown>> | undefined;
        const value = all?.[number]?.[part];
        return typeof value === 'number' ? value : undefined;
    };
}

const errorRows = (number: string, title: string): Row[] => [
    percent(`${title}: stated`, errorOf(number, 'stated'), 'the error to report, which covers about 90 of 100 tests (crackle test --verify)'),
    percent(`${title}: time step`, errorOf(number, 'time_step'), 'change at half the time step'),
    percent(`${title}: loading rate`, errorOf(number, 'rate'), 'change at half the rate'),
    percent(`${title}: damping`, errorOf(number, 'damping'), 'largest change at half and at double the damping, which is a physical effect as well as an error'),
    percent(`${title}: energy closing`, errorOf(number, 'energy_closing'), 'relative to the work of the platens'),
];

const groups: readonly {title: string; rows: readonly Row[]}[] = [
    {title: 'Specimen', rows: [
        measured('Width', 'm', key('initial_width')),
        measured('Height', 'm', key('initial_height')),
        counts('Particles', key('particles')),
        counts('Contacts at the start', key('contacts_initial')),
        counts('Bonds', key('bonds_initial'), 'bonded contact points'),
        counts('Interfaces', key('interfaces_initial'), 'bonded pairs of bodies'),
        measured('Mean back-tension', 'N', where((test) => !hasStrengths(test), key('mean_back_tension')), 'mean tensile strength of a bond'),
        measured('Mean tensile strength of a bond', 'N', key('mean_tensile_strength'), 'random factors and shares of a face included'),
        measured('Mean cohesion of a bond', 'N', key('mean_cohesion'), 'likewise'),
    ]},
    {title: 'Stiffness', rows: [
        ...stress('Nominal modulus', ['nominal_modulus'], 'stress divided by strain as this kind of test defines them, at small strain, from a sparse solve'),
        ...stress('Young’s modulus E', ['youngs_modulus'], 'at small strain with all bonds intact and sticking, from a sparse solve'),
        plain('Poisson’s ratio ν', key('poissons_ratio')),
        ...stress('Initial tangent modulus', ['initial_tangent_modulus'], 'from 0 to 5 % of the strain at peak'),
        ...stress('Tangent modulus at half the peak', ['tangent_modulus_50']),
        ...stress('Average modulus', ['average_modulus'], 'over the interval of 30 % of the peak stress that a line fits best'),
        ...stress('Secant modulus to half the peak', ['secant_modulus_50']),
        ...stress('Modulus beyond the peak', ['post_peak_modulus'], 'from 90 % down to 60 % of the peak'),
        eachCycle('Strain at each unloading', 'strain', 1 / strainFactor, strainUnit, 'axial'),
        eachCycle('Damage there', 'damage', 100, '%', '1 − modulus of the cycle over E'),
        eachCycle('Permanent strain there', 'permanent_strain', 1 / strainFactor, strainUnit, 'strain left at zero stress, extrapolated with the modulus of the cycle'),
        plain('Brittleness index (M − E)/M', key('brittleness_index'), 'M is the modulus beyond the peak; the index is 1 if the stress drops at once'),
    ]},
    {title: 'Strength', rows: [
        ...stress('Peak stress', ['peak_stress', 'peak_stress_so_far'], 'the strength, positive in the loading direction: the first maximum that is followed by a drop'),
        ...stress('Confining pressure', ['confining_pressure']),
        ...stress('Deviator at the peak', ['deviator_stress', 'deviator_stress_so_far'], 'peak less confining pressure'),
        strains('Strain at peak', either('peak_strain', 'peak_strain_so_far')),
        ...inPlaneAndSpace('Larger stress after the peak', later('largest_stress'), later('largest_stress_pa'), 'carried by pieces that are loaded again after the drop, so not the strength'),
        strains('Strain there', later('strain_at_largest_stress')),
        ...stress('Crack initiation σci', ['crack_initiation_stress'], 'stress beyond which the lateral strain exceeds the elastic one by a parabola'),
        percent('Error of crack initiation', (test) => ratio(numberOf(test.summary, 'crack_initiation_error'), numberOf(test.summary, 'crack_initiation_stress')), 'difference from a second definition, over σci'),
        percent('Crack initiation over the peak', key('crack_initiation_over_peak')),
        percent('Spread of six definitions of σci', (test) => ratio(numberIn(test, 'crack_initiation', 'spread'), numberOf(test.summary, 'crack_initiation_stress')), '(largest − smallest)/σci'),
        ...stress('Crack damage σcd', ['crack_damage_stress'], 'middle of the range of stresses up to the peak in which the area strain is within 2 % of its largest value'),
        percent('Error of crack damage', (test) => ratio(numberOf(test.summary, 'crack_damage_error'), numberOf(test.summary, 'crack_damage_stress')), 'half the width of the range of these stresses, over σcd'),
        percent('Crack damage over the peak', key('crack_damage_over_peak')),
        ...stress('Normal stress', ['normal_stress'], 'on the upper half box'),
        ...stress('Residual shear stress', ['residual_stress'], 'mean over the last tenth of the strain'),
        plain('Dilation angle at the peak, degrees', key('dilation_angle_at_peak')),
        measured('Notch', 'm', key('notch')),
        plain('Notch over a particle', key('notch_over_particle')),
        measured('Fracture toughness K_I at the largest load', '', either('fracture_toughness', 'fracture_toughness_so_far'), 'stress times √m'),
        words('Valid', verdictText),
        {name: 'Failed', cells: (tests) => ({unit: '', values: tests.map((test) => (test.failed ? 'yes' : 'no: peak so far'))})},
    ]},
    {title: 'Breakage', rows: [
        counts('Bonds broken', key('bonds_broken')),
        counts('of these in tension', (test) => modeCounts(test.events).tension),
        counts('of these in shear', (test) => modeCounts(test.events).shear),
        counts('up to the peak in tension', key('bonds_broken_in_tension_to_peak')),
        counts('up to the peak in shear', key('bonds_broken_in_shear_to_peak')),
        counts('Slips', (test) => test.slips?.count, 'bonds that reached their Coulomb limit, each counted once; not among the broken bonds unless they broke later'),
        counts('Interfaces lost', key('interfaces_lost')),
        counts('Fragments at the end', key('fragments'), 'groups of particles joined by intact bonds'),
        percent('Largest fragment', key('largest_fragment_share'), 'relative to the area of all particles'),
        measured('Median size of fragments, D50', 'm', key('fragment_size_median'), 'half of the area belongs to smaller fragments'),
        plain('Rosin–Rammler exponent of fragments', (test) => numberIn(test, 'fragment_rosin_rammler', 'exponent')),
        strains('Area strain at peak', key('area_strain_peak'), 'axial minus lateral strain, with shortening and widening positive, so positive if the area shrinks'),
        strains('Area strain at the end', key('area_strain_end')),
    ]},
    {title: 'Joints', rows: [
        counts('Bonds broken on joints', key('bonds_broken_on_joints')),
        counts('in the rock', key('bonds_broken_in_rock')),
        counts('up to the peak on joints', key('bonds_broken_on_joints_to_peak')),
        counts('up to the peak in the rock', key('bonds_broken_in_rock_to_peak')),
        eachJoint('Joints', ({source}) => source, 1, '', 'joint sets and [[trace]] tables; further rows list their values in this order'),
        eachJoint('Length of traces', ({length}) => length, 1, 'm'),
        ...jointMotions,
    ]},
    {title: 'Energy, relative to the work of the platens', rows: [
        ...(['peak', 'end'] as const).flatMap((moment) => ([['strain', 'stored'], ['friction', 'lost by sliding'], ['fracture', 'taken by breaks'], ['dashpot', 'lost in dashpots'], ['kinetic', 'of motion']] as const)
            .map(([part, title]) => percent(`${capitalised(title)}, at the ${moment}`, (test) => numberIn(test, `energy_at_${moment}`, part)))),
    ]},
    {title: 'Numerical errors', rows: [
        ...errorRows('peak_stress', 'Peak stress'),
        ...errorRows('peak_strain', 'Strain at peak'),
        percent('Crack initiation: stated', errorOf('crack_initiation_stress', 'stated'), 'as for the peak'),
        percent('Crack damage: stated', errorOf('crack_damage_stress', 'stated'), 'as for the peak'),
        words('Peak converged', (test) => {
            const value = test.summary['peak_converged'];
            return typeof value === 'boolean' ? (value ? 'yes' : 'no: not on the same branch at half the time step or rate') : undefined;
        }),
    ]},
    {title: 'Numerics', rows: [
        measured('Time step', 's', key('time_step')),
        percent('Time step over the stable one', key('time_step_over_stable'), 'time step divided by the stability limit when the bonds were made'),
        counts('Steps', key('steps')),
        percent('Energy closing error', key('energy_closing_error')),
        percent('Platens out of balance', key('platen_out_of_balance'), 'difference between the stresses at the two platens, an error due to the loading rate'),
        measured('Wall time', 's', key('wall_seconds')),
        millions('Particle-steps per second', key('particle_steps_per_second')),
        words('Seed', (test) => test.summary['seed']),
    ]},
];

export function summaryTable(tests: LabelledTest[]): HTMLElement {
    const columns = sortedBy('kind', tests);
    const data = columns.map(({test}) => test);
    const kinds = [...new Set(data.map((test) => test.kind))];
    const named = columns.every(({test, label}) => label === `${specimenName(test)}, ${test.kind}`);

    const head = element('thead', {},
        element('tr', {}, element('td', {colspan: '2'}),
            ...kinds.map((kind) => element('th', {colspan: String(data.filter((test) => test.kind === kind).length), scope: 'colgroup', class: 'kind'}, capitalised(kind)))),
        element('tr', {}, element('td'), element('td', {class: 'unit'}, 'unit'),
            ...columns.map(({test, label}, index) => element('th', {scope: 'col', class: firstOfKind(data, index)}, named ? specimenName(test) : label))));
    const body = groups.flatMap(({title, rows}) => {
        const filled = rows.map((row) => ({row, ...row.cells(data)})).filter(({values}) => values.some((value) => value !== undefined));
        if (filled.length === 0) return [];
        return [element('tbody', {},
            element('tr', {class: 'group'}, element('th', {colspan: String(columns.length + 2), scope: 'rowgroup'}, title)),
            ...filled.map(({row, unit, values}) => element('tr', {},
                element('th', {scope: 'row', ...(row.note ? {title: row.note, class: 'noted'} : {})}, row.name),
                element('td', {class: 'unit'}, unit),
                ...values.map((value, index) => element('td', {
                    class: [firstOfKind(data, index), warned(row.name, data[index]!, value) ? 'warning' : ''].join(' ').trim(),
                }, value ?? missing)))))];
    });
    return element('div', {class: 'scroll'}, element('table', {class: columns.length < 4 ? 'summary narrow' : 'summary'}, head, ...body));
}

/// Whether a value is marked with a warning: the peak of a specimen that did not fail, or a stress that is not the strength.
function warned(row: string, test: TestData, value: string | undefined): boolean {
    return (!test.failed && /^(Peak stress|Strain at peak|Failed)$/.test(row)) || (row.startsWith('Larger stress') && value !== undefined);
}

function firstOfKind(data: TestData[], index: number): string {
    return index === 0 || data[index]!.kind !== data[index - 1]!.kind ? 'first' : '';
}
