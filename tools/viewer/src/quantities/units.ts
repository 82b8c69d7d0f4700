// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers for readers: SI prefixes, significant digits, typographic minus and powers of ten.

const prefixes: readonly [number, string][] = [
    [1e12, 'T'], [1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p'],
];
const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
export const missing = '–';
/// Narrow no-break space, between a number and its unit and between groups of three digits.
export const thinSpace = '\u202f';

export interface Scale {
    factor: number; // shown value = value / factor
    unit: string; // with its prefix
}

/// Units that particle files and decks do not define; angles and times always have units.
const undefinedUnits = /^(m|m²|m\/s|N|N\/m)$/;
let unitsKnown = true;

/// From here on lengths and forces are shown as plain numbers: for a page that shows more than tests.
export function useFileUnits(): void {
    unitsKnown = false;
}

/// Stands for the unit of stresses and moduli, which depends on the tests of the page.
export const ofStress = 'stress';
let stressUnits: readonly string[] = ['N/m'];

/// @param units of the page's tests: N/m, Pa, or both
export function useStressUnits(units: readonly string[]): void {
    stressUnits = units;
}

/// The prefix that puts the largest of the values between 1 and 1000.
export function scaleFor(values: readonly (number | undefined)[], unit: string): Scale {
    const names = unit === ofStress ? stressUnits : [unit];
    if (!unitsKnown && names.some((name) => undefinedUnits.test(name))) return {factor: 1, unit: 'file’s units'};
    const largest = Math.max(0, ...values.map((value) => Math.abs(value ?? 0)).filter(Number.isFinite));
    const [factor, prefix] = (largest > 0 && prefixes.find(([size]) => largest >= size * 0.9995)) || ([1, ''] as const);
    return {factor, unit: names.map((name) => prefix + name).join(' or ')};
}

const withMinus = (text: string): string => text.replace('-', '−');

/// `digits` significant digits, fewer where the last would be finer than the numbers are stored (`resolution`); without
/// an exponent where that stays readable.
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

/// 1.23×10⁻⁵
export function scientific(value: number, digits = 3): string {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return withMinus(`${mantissa}×10${powerOfTen(Number(exponent))}`);
}

export function powerOfTen(exponent: number): string {
    const digits = [...String(Math.abs(exponent))].map((digit) => superscripts[Number(digit)]).join('');
    return (exponent < 0 ? '⁻' : '') + digits;
}

/// Whole numbers, digits in groups of three.
export function counted(value: number | undefined): string {
    if (value === undefined || !Number.isFinite(value)) return missing;
    return withMinus(Math.round(value).toString()).replace(/\B(?=(\d{3})+$)/g, thinSpace);
}

/// A quantity with its unit and a prefix chosen for this value.
export function quantity(value: number | undefined, unit: string, digits = 3, resolution = 0): string {
    if (value === undefined) return missing;
    const scale = scaleFor([value], unit);
    return `${significant(value / scale.factor, digits, resolution / scale.factor)}${thinSpace}${scale.unit}`;
}

const leastStress = 0.005; // of the peak

/// A stress of a test; what the inertia and the dashpots of the start leave, far below the peak, is no stress of the rock.
export function stressText(value: number | undefined, peak: number | undefined): string {
    return value !== undefined && Math.abs(value) < leastStress * (peak ?? 0) ? '≈ 0' : quantity(value, ofStress);
}

/// Strains are shown in thousandths: 1.94×10⁻³.
export const strainFactor = 1e-3;
export const strainUnit = '10⁻³';
export function strain(value: number | undefined, digits = 3): string {
    if (value === undefined) return missing;
    return value === 0 ? '0' : `${significant(value / strainFactor, digits)}×10⁻³`;
}
