"""The pictures that `make study-samples` compares, and how its result is read."""

import pathlib

RESULT = pathlib.Path(__file__).resolve().parent.parent / "out/samples/samples.json"
SCHEMA = ("halfspace-samples", 1)
SAMPLES = (1, 2, 4, 8, 16)
TIMES = (1, 2, 4)  # as wide and high: 1, 4 and 16 samples a pixel
FILTERS = ("box", "tent")
MULTISAMPLING = "multisampling"


def supersampling(picture_filter):
    return f"supersampling, {picture_filter}"


# {method: samples of a pixel that it is measured with}
METHODS = {MULTISAMPLING: SAMPLES} | {supersampling(each): tuple(times**2 for times in TIMES) for each in FILTERS}
