// SPDX-License-Identifier: GPL-3.0-or-later
// Formats numbers with SI prefixes, significant digits, typographic minus and powers of ten.

import type {UnitNames} from '../data/report';

const prefixes: readonly [number, string][] = [
    [1e12, 'T'], [1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p'],
];
const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
export const missing = '–';
/// Narrow no-break space, between a number and its unit and between groups of three digits.
export const thinSpace = '\u202f';

export interface Scale {
    factor: number; // shown value = value / factor
    power: string; // such as "10⁶", for a unit without SI prefixes
    unit: string; // unit with its prefix; empty if the unit is unknown
}

/// For each SI unit, the quantity whose unit particle files and decks do not state. Units of angles and times are
/// always known.
const unstated: Record<string, Exclude<keyof UnitNames, 'prefixes'>> = {m: 'length', 'm/s': 'velocity', N: 'force', J: 'energy', 'N/m': 'stress'};
let statedUnits = true;
let unitNames: UnitNames | undefined;

/// Switches lengths and forces to the units of particle files and decks, for a page that shows any of them.
/// @param names  names of the units, as given by the user; if undefined, values are shown as plain numbers
export function useFileUnits(names: UnitNames | undefined): void {
    statedUnits = names?.prefixes === true;
    unitNames = names;
}

/// Placeholder for the unit of stresses and moduli, which depends on the tests on the page.
export const ofStress = 'stress';
let stressUnits: readonly string[] = ['N/m'];

/// @param units  units of the tests on the page: N/m, Pa, or both
export function useStressUnits(units: readonly string[]): void {
    stressUnits = units;
}

/// Scale with the SI prefix for which the largest of the values is between 1 and 1000.
export function scaleFor(values: readonly (number | undefined)[], unit: string): Scale {
    const names = unit === ofStress ? stressUnits : [unit];
    const largest = Math.max(0, ...values.map((value) => Math.abs(value ?? 0)).filter(Number.isFinite));
    const kind = unstated[names[0]!];
    if (!statedUnits && kind) return powerFor(largest, unitNames?.[kind] ?? '');
    const [factor, prefix] = (largest > 0 && prefixes.find(([size]) => largest >= size * 0.9995)) || ([1, ''] as const);
    return {factor, power: '', unit: names.map((name) => prefix + name).join(' or ')};
}

const longest = 1e4, shortest = 1e-2; // range of numbers shown without a power of ten

function powerFor(largest: number, unit: string): Scale {
    if (largest === 0 || (largest >= shortest && largest < longest)) return {factor: 1, power: '', unit};
    const exponent = 3 * Math.floor(Math.log10(largest) / 3);
    return {factor: 10 ** exponent, power: `10${powerOfTen(exponent)}`, unit};
}

/// Text such as "10⁶ dyn".
export function unitOf({power, unit}: Scale): string {
    return [power, unit].filter((part) => part !== '').join(thinSpace);
}

/// Text such as "Force [10⁶ dyn]"; for an unknown unit, only the name and the power of ten.
export function titled(name: string, scale: Scale): string {
    const inside = unitOf(scale);
    return inside === '' ? name : `${name} [${inside}]`;
}

/// Title of an axis or legend that stands alone. If the unit is unknown, the title says «deck’s units».
export function titledInFull(name: string, scale: Scale): string {
    return titled(name, scale.unit === '' ? {...scale, unit: 'deck’s units'} : scale);
}

/// Text that follows a number, such as "×10⁶ dyn".
export function suffixOf({power, unit}: Scale): string {
    return (power === '' ? '' : `×${power}`) + (unit === '' ? '' : thinSpace + unit);
}

const withMinus = (text: string): string => text.replace('-', '−');

/// Formats a number with `digits` significant digits, or fewer if the last digits would be below its `resolution`. An exponent
/// is used only if the number would be hard to read without it.
export function significant(value: number | undefined, digits = 3, resolution = 0): string {
    if (value === undefined || !Number.isFinite(value)) return missing;
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (resolution > 0) {
        const finest = Math.ceil(Math.log10(resolution)), last = Math.floor(Math.log10(size)) + 1 - digits;
        if (finest > last) {
            const unit = 10 ** finest, left = digits - (finest - last);
            return significant(Math.round(value / unit) * unit, Math.max(1, left));
        }
    }
    if (size >= 1e6 || size < 1e-3) return scientific(value, digits);
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Number(size.toPrecision(digits)))));
    return withMinus(value.toFixed(decimals));
}

/// Formats a number such as 1.23×10⁻⁵.
export function scientific(value: number, digits = 3): string {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return withMinus(`${mantissa}×10${powerOfTen(Number(exponent))}`);
}

export function powerOfTen(exponent: number): string {
    const digits = [...String(Math.abs(exponent))].map((digit) => superscripts[Number(digit)]).join('');
    return (exponent < 0 ? '⁻' : '') + digits;
}

/// Formats a whole number with its digits in groups of three.
export function counted(value: number | undefined): string {
    if (value === undefined || !Number.isFinite(value)) return missing;
    return withMinus(Math.round(value).toString()).replace(/\B(?=(\d{3})+$)/g, thinSpace);
}

/// A quantity with its unit and a prefix chosen for this value.
export function quantity(value: number | undefined, unit: string, digits = 3, resolution = 0): string {
    if (value === undefined) return missing;
    const scale = scaleFor([value], unit);
    return significant(value / scale.factor, digits, resolution / scale.factor) + suffixOf(scale);
}

const leastStress = 0.005; // relative to the peak

/// A stress of a test as text. Values far below the peak are shown as ≈ 0, since they come from inertia and dashpots at the start.
export function stressText(value: number | undefined, peak: number | undefined): string {
    return value !== undefined && Math.abs(value) < leastStress * (peak ?? 0) ? '≈ 0' : quantity(value, ofStress);
}

/// Strains are shown in thousandths, such as 1.94 ‰.
export const strainFactor = 1e-3;
export const strainUnit = '‰';
export function strain(value: number | undefined, digits = 3): string {
    if (value === undefined) return missing;
    return value === 0 ? '0' : significant(value / strainFactor, digits) + thinSpace + strainUnit;
}
