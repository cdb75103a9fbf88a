// How words are written and read: whole numbers of 16 bits.

export type NumberForm = 'decimal' | 'hex' | 'binary';
export const numberForms: readonly NumberForm[] = ['decimal', 'hex', 'binary'];

export function shownWord(value: number | undefined, form: NumberForm = 'decimal'): string {
  if (value === undefined) return '–';
  if (form === 'decimal') return String(value);
  const bits = value & 0xffff;
  return form === 'hex'
    ? `0x${bits.toString(16).toUpperCase().padStart(4, '0')}`
    : bits
        .toString(2)
        .padStart(16, '0')
        .replace(/(\d{4})(?=\d)/g, '$1 ');
}

/** One word: -32768 to 32767, 0x… and 0b… to 16 bits. null if it is none. */
export function readWord(text: string): number | null {
  const trimmed = text.trim();
  const based = /^(-?)0([xb])([0-9a-f]+)$/i.exec(trimmed);
  if (based) {
    const radix = based[2]?.toLowerCase() === 'x' ? 16 : 2;
    const digits = based[3] ?? '';
    if (radix === 2 && !/^[01]+$/.test(digits)) return null;
    const bits = parseInt(digits, radix);
    if (bits > 0xffff) return null;
    return inRange(based[1] ? -bits : bits > 0x7fff ? bits - 0x10000 : bits);
  }
  return /^[+-]?\d{1,6}$/.test(trimmed) ? inRange(Number(trimmed)) : null;
}

/** Words with spaces or commas between, with or without brackets; null if one of them is none. */
export function readWords(text: string): number[] | null {
  const parts = text
    .trim()
    .replace(/^\[|\]$/g, '')
    .split(/[\s,;]+/)
    .filter(Boolean);
  const words = parts.map(readWord);
  return words.some((word) => word === null) ? null : (words as number[]);
}

/** "12", "1 k", "3.4 M": a count in four letters at most. */
export function shortCount(count: number): string {
  if (count < 10_000) return String(Math.round(count));
  return count < 999_500 ? `${Math.round(count / 1000)} k` : `${(count / 1e6).toFixed(1)} M`;
}

/** "0.4", "12": something by the second. */
export function shownRate(rate: number): string {
  return rate > 0 && rate < 9.95 ? rate.toFixed(1) : shortCount(rate);
}

/** Seconds with their thousandths. */
export function shownTime(t: number): string {
  return t.toFixed(3);
}

function inRange(value: number): number | null {
  return value >= -32768 && value <= 32767 ? value : null;
}
