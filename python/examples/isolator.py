# %% [markdown]
# # An isolator chosen
# Which base keeps a statue standing under a suite of motions, with 35 cm to move and 2 cm vertically?

# %%
import matplotlib.pyplot as plt
from motions import write_suite

import topple

LIMIT_U, LIMIT_V = 0.35, 0.02
records = write_suite("records", 20, peak_h=4.0)
region = topple.envelope(
    records, object=1, eccentricity=0.2, t_h="0.3:3:40", t_v="0.1:0.8:40", u_y=0.02,
    standing=1.0, limit_u=LIMIT_U, limit_v=LIMIT_V, both_directions=True,
)
feasible = region.feasible == 1
print(f"{float(feasible.mean()):.0%} of the bases are feasible")

# %% [markdown]
# Of the feasible bases the one with the least stroke.

# %%
stroke = region.max_u_100.where(feasible)
best = region.isel(stroke.argmin(["t_v", "t_h"]))
print(f"T_h = {best.t_h.item():.2f} s, T_v = {best.t_v.item():.2f} s: stroke {best.max_u_100.item():.3f} m")

# %%
figure, ax = plt.subplots(figsize=(6.4, 4.8), layout="constrained")
axes = (region.t_h, region.t_v)
mesh = ax.pcolormesh(*axes, region.standing, cmap="Greys_r", vmax=1.0, rasterized=True)
figure.colorbar(mesh, ax=ax, label="share of motions under which the statue stands")
ax.contourf(*axes, feasible.astype(float), levels=[0.5, 1.5], colors="#d6f4b8")
ax.contour(*axes, region.max_u_100, levels=[LIMIT_U], colors="#12459e")
ax.contour(*axes, region.stroke_v_100, levels=[LIMIT_V], colors="#c61f1a")
ax.plot([], [], color="#12459e", label=f"horizontal stroke {LIMIT_U} m")
ax.plot([], [], color="#c61f1a", label=f"vertical stroke {LIMIT_V} m")
ax.plot([], [], "s", color="#d6f4b8", markersize=10, label="feasible")
ax.plot(best.t_h, best.t_v, "*", color="#418c66", markersize=14, label="feasible, least stroke")
ax.set(xlabel="$T_h$ [s]", ylabel="$T_v$ [s]")
ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, frameon=False)
figure.savefig("isolator.png", dpi=100)
