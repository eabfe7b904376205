// A block on its base: what depends on the block, the masses and the restitution alone. Twin: src/cells/body.rs, bounds.rs and
// coefficients.rs.

import { arm, criticalAngle, overturningAngle } from './block.js';
import { sharesOf } from './isolation.js';
import { known } from './known.js';

// What a body depends on: the numbers of a scene's block, and the restitution.
export function bodyParameters() {
  const own = known.parameters.filter((entry) => entry.section === 'block').map((entry) => entry.key);
  return [...own, 'restitution', 'restitution_factor'];
}

export class Body {
  constructor(cell) {
    const { block, base } = cell;
    this.block = block;
    [this.muH, this.muV] = sharesOf(base, block);
    this.restitution = cell.restitution;
    this.restitutionFactor = cell.restitutionFactor;
    this.overturn = cell.overturn;
    this.rho2 = block.inertia / block.mass;
    this.arms = [arm(block, 1), arm(block, -1)];
  }

  // rho^2 + H^2 kappa_h + b^2 kappa_v for lever arm b.
  impactInertia(b) {
    const height2 = this.block.height * this.block.height;
    return this.rho2 + height2 * (1 - this.muH) + b * b * (1 - this.muV);
  }

  // Rate at which a block that stands on a corner falls back, rad/s^2.
  fall() {
    const b = Math.max(...this.arms);
    return (known.gravity * b) / this.impactInertia(b);
  }

  // No larger than I/M - mu_h P^2 - mu_v Q^2 about a corner in any position.
  swingInertia(b) {
    const { height } = this.block;
    const radius2 = height * height + b * b;
    const least = this.rho2 + radius2 * (1 - Math.max(this.muH, this.muV));
    return Math.min(this.impactInertia(b), least);
  }

  // The square of the base's largest frequency with the block rocking on it, over omega_h^2.
  stiffeningH() {
    return this.arms.map((b) => {
      const [h2, b2] = [this.block.height * this.block.height, b * b];
      return 1 + (this.muH * (h2 + b2)) / this.swingInertia(b);
    });
  }

  // The most rate of a motion against an end stop, 1/s: that of its spring under the block that rocks, and of its damper.
  stopRate(stop) {
    const stiffening = Math.max(...this.stiffeningH());
    return Math.max(Math.sqrt(stop.stiffness * stiffening), stop.damping * stiffening);
  }

  // The same of omega_v.
  stiffeningV() {
    return this.arms.map((b) => {
      const [h2, b2] = [this.block.height * this.block.height, b * b];
      const q2 = this.overturn === 'quarter-turn' ? b2 + h2 : b2;
      return 1 + (this.muV * q2) / this.swingInertia(b);
    });
  }

  // p^2 about the two corners, or what a light base makes of it at most, 1/s^2.
  mostP2() {
    return this.arms.map((b) => (known.gravity * Math.hypot(b, this.block.height)) / this.swingInertia(b));
  }

  // b of the longer lever arm, H, and R of the longer arm.
  dimensions() {
    const b = Math.max(...this.arms);
    return [b, this.block.height, Math.hypot(b, this.block.height)];
  }

  // D at its least.
  leastD() {
    return this.rho2 + (1 - this.muH) * this.block.height * this.block.height;
  }

  // The most by which impacts to come can raise the energy.
  impactGain() {
    if (this.restitution === undefined) return 1;
    const inertia = (b) => this.rho2 + this.block.height * this.block.height + b * b;
    const ratio = inertia(this.arms[0]) / inertia(this.arms[1]);
    return Math.max(this.restitution * this.restitution * Math.max(ratio, 1 / ratio), 1);
  }

  // The least share of f_v in the normal force.
  normalShare() {
    const [b] = this.dimensions();
    return this.leastD() / (this.leastD() + (1 - this.muV) * b * b);
  }

  // The most of P Q/D.
  mostPQ() {
    const [b, h, r] = this.dimensions();
    const [kappaH, kappaV] = [1 - this.muH, 1 - this.muV];
    if (h >= b && kappaH * h * h >= kappaV * b * b) return (h * b) / (this.leastD() + kappaV * b * b);
    return (r * b) / this.leastD();
  }

  // The most of a lever times w [1 +- (mu_h - mu_v) (other lever)^2/D] over the energy.
  mostByTurn(byHeight) {
    const [b, , r] = this.dimensions();
    const d = this.leastD();
    const apart = Math.abs(this.muH - this.muV);
    const [lever, other] = byHeight ? [r, (apart * b * b) / d] : [b, (apart * r * r) / d];
    return (2 * lever * (1 + other)) / d;
  }

  // Share of u's inertia that is left to it where the block is free to rock, and the same of v.
  freeShareH() {
    const [, , r] = this.dimensions();
    return this.leastD() / (this.leastD() + this.muH * r * r);
  }

  freeShareV() {
    const [b] = this.dimensions();
    return this.leastD() / (this.leastD() + this.muV * b * b);
  }

  corner(side) {
    const { block, muH, muV, rho2 } = this;
    const [h, b, c] = [block.height, arm(block, side), arm(block, -side)];
    const width = 2 * block.halfWidth;
    const [kappaH, kappaV] = [1 - muH, 1 - muV];
    const d = this.impactInertia(b);
    const byLaw = (rho2 + h * h * kappaH - b * c * kappaV) / d;
    const less = (1 - this.restitutionFactor) * byLaw;
    return [
      side,
      b,
      rho2 + b * b + h * h,
      overturningAngle(block, side, this.overturn),
      this.restitution ?? this.restitutionFactor * byLaw,
      (width * b * h * muH * kappaV) / d + muH * h * less,
      (width * muV * (h * h * kappaH + rho2)) / d - muV * b * less,
      0,
    ];
  }

  // The numbers of its equations, in the order of the shader's Model.
  model() {
    const { block, muH, muV } = this;
    const radius = (b) => Math.hypot(b, block.height);
    const inverse = (mu) => (mu > 0 ? 1 / mu : 0);
    return [
      ...this.corner(1),
      ...this.corner(-1),
      block.height,
      muH,
      muV,
      known.gravity,
      inverse(muH),
      inverse(muV),
      Math.min(...this.arms),
      known.gravity * (Math.min(...this.arms.map(radius)) - block.height),
      this.impactGain(),
      this.normalShare(),
      (1 - muV) * this.mostPQ(),
      (1 - muV) * this.mostByTurn(true),
      (1 - muH) * this.mostPQ(),
      (1 - muH) * this.mostByTurn(false),
      0,
      0,
    ];
  }

  // alpha about the left and the right corner, rad.
  critical() {
    return [criticalAngle(this.block, 1), criticalAngle(this.block, -1)];
  }
}
