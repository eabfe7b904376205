# %% [markdown]
# # An isolator chosen
# Which base keeps a server cabinet standing under a suite of motions, with 25 cm to move and 5 cm to settle?

# %%
import matplotlib.pyplot as plt
from motions import write_suite

import topple

records = write_suite("records", 20, peak_h=5.0)
region = topple.envelope(
    records, object=2, t_h="0.5:3:40", t_v="0.1:0.8:40", u_y=0.01, standing=1.0, limit_u=0.25, limit_v=0.05,
    both_directions=True,
)
feasible = region.feasible == 1
print(f"{float(feasible.mean()):.0%} of the bases are feasible")

# %% [markdown]
# Of the feasible bases the one with the least stroke, and the motion that governs it.

# %%
stroke = region.max_u_100.where(feasible)
best = region.isel(stroke.argmin(["t_v", "t_h"]))
print(f"T_h = {best.t_h.item():.2f} s, T_v = {best.t_v.item():.2f} s: stroke {best.max_u_100.item():.3f} m")

# %%
figure, ax = plt.subplots(figsize=(6.4, 4.8), layout="constrained")
mesh = ax.pcolormesh(region.t_h, region.t_v, region.standing, cmap="Greys_r", vmin=0.0, vmax=1.0, rasterized=True)
figure.colorbar(mesh, ax=ax, label="share of motions under which it stands")
ax.contour(region.t_h, region.t_v, region.max_u_100, levels=[0.25], colors="#12459e")
ax.contour(region.t_h, region.t_v, region.stroke_v_100, levels=[0.05], colors="#c61f1a")
ax.plot(best.t_h, best.t_v, "*", color="#418c66", markersize=14, label="least stroke")
ax.set(xlabel="$T_h$ [s]", ylabel="$T_v$ [s]")
ax.legend(frameon=False)
figure.savefig("isolator.png", dpi=100)
