//! A linear oscillator on the ground: the exact solution between samples, where the ground's acceleration is linear (Nigam &
//! Jennings 1969, "Calculation of response spectra from strong-motion earthquake records").

/// What takes an oscillator over a step of linear acceleration.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// exp(-xi omega h) times the sine and the cosine of the damped phase.
    sine: f64,
    cosine: f64,
    omega: f64,
    damping: f64,
    damped: f64,
    /// Its length, s.
    pub h: f64,
}

/// The motion within a step, p + q t + exp(-xi omega t) (x cos(omega_d t) + y sin(omega_d t)): the particular solution is
/// linear as the acceleration is, the rest swings freely.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    p: f64,
    q: f64,
    x: f64,
    y: f64,
    /// No |u''| in the step is larger.
    pub bend: f64,
}

impl Step {
    /// That of an oscillator of a frequency, rad/s, and a share of the critical damping below 1.
    pub fn of(omega: f64, damping: f64, h: f64) -> Step {
        let damped = omega * (1.0 - damping * damping).sqrt();
        let decay = (-damping * omega * h).exp();
        let (sine, cosine) = (damped * h).sin_cos();
        Step { sine: decay * sine, cosine: decay * cosine, omega, damping, damped, h }
    }

    /// The derivative of a free swing with these factors of the cosine and the sine.
    fn derivative(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Step { omega, damping, damped, .. } = *self;
        [damped * y - damping * omega * x, -damped * x - damping * omega * y]
    }

    /// The motion of u'' + 2 xi omega u' + omega^2 u = -a with a linear from `from` to `to`.
    pub fn motion(&self, u: f64, du: f64, from: f64, to: f64) -> Motion {
        let Step { omega, damping, damped, h, .. } = *self;
        let square = omega * omega;
        let slope = (to - from) / h;
        let q = -slope / square;
        let p = (-from - 2.0 * damping * omega * q) / square;
        let (x, dx) = (u - p, du - q);
        let y = (dx + damping * omega * x) / damped;
        let [a, b] = self.derivative(self.derivative([x, y]));
        // Of a cos + b sin: in a short step the sine stays small.
        let bend = (a * a + b * b).sqrt().min(a.abs() + b.abs() * damped * h);
        Motion { p, q, x, y, bend }
    }

    /// u and u' at the step's end.
    pub fn end(&self, motion: &Motion) -> (f64, f64) {
        let Motion { p, q, x, y, .. } = *motion;
        let [a, b] = self.derivative([x, y]);
        let of = |cosine: f64, sine: f64| cosine * self.cosine + sine * self.sine;
        (p + q * self.h + of(x, y), q + of(a, b))
    }

    /// u at a time of the step.
    pub fn at(&self, motion: &Motion, t: f64) -> f64 {
        let Motion { p, q, x, y, .. } = *motion;
        let (sine, cosine) = (self.damped * t).sin_cos();
        p + q * t + (-self.damping * self.omega * t).exp() * (x * cosine + y * sine)
    }
}
