# %% [markdown]
# The relation of radius to texel, from the two files that `scumble-analysis fit … --out OUT` writes: `trials.csv`, one row a
# trial, and `relation.json`. Both load as they are; the rest fits thresholds anew and draws them against the texel size
# (Kreuzer 2017, Fig. 4.6). Needs pandas and matplotlib:
#
#     python docs/relation.py OUT figure.png

# %%
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

folder, picture = sys.argv[1], sys.argv[2]

# %% Two lines.
trials = pd.read_csv(f"{folder}/trials.csv")
relation = json.load(open(f"{folder}/relation.json"))

print(pd.json_normalize(relation["conditions"]).round(2).to_string(index=False))
print(pd.json_normalize(relation["population"])[["viewers", "detection", "ratio.value", "ratio.ci95"]].round(2).to_string(index=False))

# %% [markdown]
# A threshold is the ratio at which the artifact is detected on 64 % of the trials. The Weibull function has the slope and the share of
# blind trials that the mixed model found; its location is the most likely one of a fine grid.

# %%
DETECTED = 0.64
slope, blind = relation["model"]["slope_per_log10"], relation["model"]["blind_share"]
grid = np.arange(-1.0, 2.0, 0.001)  # log10 of the ratio


def log10_threshold(answers, guess):
    """Most likely log10 ratio at the threshold; NaN where the answers do not bound it."""
    above = np.log10(answers.ratio.to_numpy())[:, None] - grid  # log10 of the ratio shown over the threshold
    w = -np.log(1 - DETECTED / (1 - blind))
    detected = (1 - blind) * (1 - np.exp(-w * 10 ** (-slope * above)))
    p = guess + (1 - guess) * detected
    right = answers.correct.to_numpy()[:, None].astype(bool)
    likelihood = np.log(np.where(right, p, 1 - p)).sum(axis=0)
    best = likelihood.argmax()
    # 1.92 is half of the 95 % quantile of chi-squared with one degree of freedom.
    bounded = likelihood[best] - max(likelihood[0], likelihood[-1]) > 1.92
    return grid[best] if bounded else np.nan


def guess_rate(person):
    """One half with two pictures; with one, how often the person called a line an artifact."""
    lines = trials[(trials.person == person) & (trials.role == "line") & (trials.stands == 1) & trials.excluded.isna()]
    return 0.5 if lines.empty else ((1 - lines.correct).sum() + 0.5) / (len(lines) + 1)


measured = trials[(trials.role == "measure") & (trials.stands == 1) & trials.excluded.isna()]
condition = ["pattern", "contrast", "kernel"]
thresholds = pd.DataFrame(
    {**dict(zip([*condition, "texel_px", "person"], key)), "ratio": 10 ** log10_threshold(answers, guess_rate(key[-1]))}
    for key, answers in measured.groupby([*condition, "texel_px", "person"])
)
thresholds["radius_px"] = thresholds.ratio * thresholds.texel_px

# %% The mean of the people's log10 ratios in the worst condition, which relation.json has too.
worst = max(relation["conditions"], key=lambda entry: entry["ratio"]["value"])
here = measured[(measured[condition] == [worst[key] for key in condition]).all(axis=1)]
own = [log10_threshold(answers, guess_rate(person)) for person, answers in here.groupby("person")]
mean = 10 ** np.nanmean(own)
print(f"mean of logarithms, {worst['pattern']} at {worst['contrast']:.0%} contrast: {mean:.3f}")

# %% The figure: people, their geometric means, the line of the median person with its interval.
contrasts = sorted(thresholds.contrast.unique(), reverse=True)
figure, axes = plt.subplots(1, len(contrasts), figsize=(5.5 * len(contrasts), 4.5), sharey=True, squeeze=False)
colours = {"stair": "#0072b2", "step": "#d55e00", "double_step": "#009e73"}  # Okabe and Ito
for axis, contrast in zip(axes[0], contrasts):
    for entry in (entry for entry in relation["conditions"] if entry["contrast"] == contrast):
        own = thresholds[(thresholds[condition] == [entry[key] for key in condition]).all(axis=1)].dropna()
        colour, end = colours[entry["pattern"]], 1.08 * own.texel_px.max()
        low, high = entry["ratio"]["ci95"]
        axis.fill_between([0, end], [0, low * end], [0, high * end], color=colour, alpha=0.13, lw=0)
        axis.plot([0, end], [0, entry["ratio"]["value"] * end], color=colour, label=f"{entry['pattern']} {entry['ratio']['value']:.2f}")
        axis.plot(own.texel_px, own.radius_px, ".", color=colour, alpha=0.3, ms=4)
        means = 10 ** np.log10(own.radius_px).groupby(own.texel_px).mean()
        axis.plot(means.index, means, "o", mfc="white", color=colour)
    axis.set(title=f"{contrast:.0%} contrast", xlabel="texel size, pixels", xlim=(0, None), ylim=(0, None))
    axis.legend(frameon=False)
axes[0, 0].set_ylabel("filter radius at threshold, pixels")
figure.savefig(picture, dpi=130, bbox_inches="tight")
