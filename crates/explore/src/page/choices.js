// Beside which choices of a scene a number of the table means something. Twin: src/scene/applies.rs.

/** The choices of a scene's text; `excitation` is a pulse or a record. */
export const choicesOf = (scene, excitation) => ({
  block: scene.object ? 'object' : 'numbers',
  isolation: scene.isolation || 'dual',
  excitation,
  shape: scene.shape || 'one-sine',
});

/** True where a parameter means something beside some choices. */
export const isBeside = ({ applies }, choices) => Object.entries(choices).every(([of, chosen]) => applies[of]?.includes(chosen) ?? true);
