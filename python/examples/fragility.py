# %% [markdown]
# # How likely a block falls
# A statue on an isolated base under a suite of twenty motions, each scaled to levels of its peak ground acceleration.

# %%
import matplotlib.pyplot as plt
import numpy as np
from motions import write_suite

import topple

records = write_suite("records", 20)
found = topple.suite(records)
print(f"{found.sizes['id']} motions, arias intensity {found.arias.values.min():.1f} to {found.arias.values.max():.1f} m/s")

# %%
result = topple.fragility(
    records, object=1, eccentricity=0.2, t_h=1.75, t_v=0.4, u_y=0.02, im="pga", levels="2:16:15", bootstrap=200
)
counts, fits = result["fragility"], result["fits"]
for state in ("uplift", "overturning"):
    fit = fits.sel(limit_state=state, estimator="stripes")
    print(f"{state}: median {fit.theta.item():.2f} m/s2, dispersion {fit.beta.item():.2f}")

# %% [markdown]
# The shares of the motions under which it fails, and the fitted lognormal distributions.

# %%
from statistics import NormalDist

figure, ax = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
levels = np.linspace(1.0, 16.0, 200)
for state, colour in (("uplift", "#418c66"), ("overturning", "#c61f1a")):
    share = counts.sel(limit_state=state)
    ax.plot(counts.level, (share.failed / share.records).squeeze(), "o", color=colour, label=f"{state}, motions")
    fit = fits.sel(limit_state=state, estimator="stripes")
    if np.isfinite(fit.theta):
        curve = [NormalDist().cdf(np.log(level / fit.theta.item()) / fit.beta.item()) for level in levels]
        ax.plot(levels, curve, color=colour, label=f"{state}, fit")
ax.set(xlabel="PGA [m/s²]", ylabel="probability", xlim=(0.0, 16.0), ylim=(0.0, 1.0))
ax.legend(frameon=False)
figure.savefig("fragility.png", dpi=100)
