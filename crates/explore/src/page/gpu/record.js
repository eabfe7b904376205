// The record that a page was exported with, scaled as a scene has it. Twin: src/scene/excitation.rs and
// crates/records/src/pair.rs.

// The record of a scene of these numbers: a single factor or peak is in its samples, several are the cells' own.
export function scaledRecord(record, numbers) {
  const single = (key) => (numbers.get(key)?.count === 1 ? numbers.get(key).start : undefined);
  const [scale, pga] = [single('scale'), single('pga')];
  let factor = 1;
  if (scale !== undefined) factor = scale / record.factor;
  else if (pga !== undefined) factor = pga / record.pga_h;
  const scaled = record.samples.map((a) => a * factor);
  // The horizontal samples are every second one.
  const peak = scaled.reduce((most, a, k) => (k % 2 === 0 ? Math.max(most, Math.abs(a)) : most), 0);
  return { ...record, samples: Float32Array.from(scaled), factor: record.factor * factor, pga_h: peak };
}
