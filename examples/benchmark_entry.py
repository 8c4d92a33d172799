"""An entry of one's own: sh scripts/run.sh benchmark run --entry examples/benchmark_entry.py:MostAlikeUtterance."""

import numpy as np

import signimit as si


class MostAlikeUtterance:
    """Repeats the demonstration whose signs were most alike, about the object it was nearest to."""

    def observe(self, demonstrations):
        self.known = [([si.normalised_sign(s) for s in d.signs], d) for d in demonstrations]

    def begin(self, signs, objects):
        asked = [si.normalised_sign(s) for s in signs]
        costs = [sum(map(si.dtw_distance, asked, heard)) for heard, _ in self.known]
        shown = self.known[int(np.argmin(costs))][1]
        gaps = np.linalg.norm(shown.hand[:, None] - shown.objects, axis=2)
        focus = gaps.mean(axis=0).argmin()
        self.path = shown.hand - shown.objects[focus] + objects[focus]

    def act(self, observation):
        step, half = round(observation.seconds * 50), len(self.path) // 2
        aim = self.path[step if step < len(self.path) else half + step % half]  # then the second half, on and on
        return (aim - observation.hand) / 0.1  # m/s: most of the way in 0.1 s
