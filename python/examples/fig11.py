# %% [markdown]
# # The paper's Fig. 11
# Overturning spectral maps of Object 1 under one-sine pulses: three eccentricities, without vertical ground motion.

# %%
import matplotlib.pyplot as plt

import topple

figure, axes = plt.subplots(1, 3, figsize=(14, 6.4), layout="constrained")
for ax, eccentricity in zip(axes, (0.0, 0.2, 0.4)):
    ds = topple.pulse(
        object=1, eccentricity=eccentricity, t_h=1.75, t_v=0.75, omega="0.2:40:300", a_h="0.1:80:300", verify=32,
        title=f"e/B = {eccentricity}",
    )
    ds.topple.plot(ax=ax)
    print(f"e/B = {eccentricity}: {float(ds.outcome.isin([2, 3]).mean()):.1%} of the cells overturn")
figure.savefig("fig11.png", dpi=100)

# %% [markdown]
# What the reference says of the last map, and what a cell of it does.

# %%
print(ds.attrs["verification"])
motion = ds.topple.history(omega=9.0, a_h=12.0)
print(f"largest |φ| {float(abs(motion.phi).max()):.3f} rad, {(motion['mode'] != 'full_contact').sum().item()} rows rocking")
