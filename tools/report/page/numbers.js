/** With four digits that count: "0.01235", "1.234e-7", "12350". */
export function shortNumber(value) {
  if (value === null || value === undefined) return '';
  if (!Number.isFinite(value)) return 'none';
  if (Number.isInteger(value) && Math.abs(value) < 1e7) return String(value);
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(3).replace(/\.?0+e/, 'e');
  return String(Number(value.toPrecision(4)));
}

export function seconds(value) {
  if (value >= 120) return `${Math.floor(value / 60)} min ${Math.round(value % 60)} s`;
  return value >= 1 ? `${value.toPrecision(3)} s` : `${(1e3 * value).toPrecision(3)} ms`;
}
