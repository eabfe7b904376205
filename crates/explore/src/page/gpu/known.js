// What the library knows of the model, read from model.json: constants, the parameter table, the blocks of Table 1. No
// number of it is written a second time in these modules.

import { isBeside } from '../choices.js';

export let known = null;

// The first parameter that is given and means nothing beside some choices.
export const excludedBy = (choices, numbers) => known.parameters.find((entry) => numbers.has(entry.key) && !isBeside(entry, choices));

// Takes over the contents of model.json.
export function learn(model) {
  known = model;
  known.parameter = new Map(model.parameters.map((entry) => [entry.key, entry]));
  if (known.record) known.record.samples = Float64Array.from(known.record.samples);
  known.shape = new Map(model.shapes.map((shape) => [shape.name, shape]));
}
