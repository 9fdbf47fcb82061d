"""What the precision study compares in gates: rtl/study, one edge or one depth a cycle."""

from synthesis.units import SAMPLE_MULTIPLIERS, TILE_MULTIPLIERS, UNITS, Configuration, Unit

FLOAT32 = {"ExponentBits": 8, "FractionBits": 23}
DOUBLE = {"ExponentBits": 11, "FractionBits": 52}


def _integer(step_bits: int, sum_bits: int) -> Configuration:
    return Configuration("edge_integer", {}, {"StepBits": step_bits, "SumBits": sum_bits}, 2)


def _fixed(sub_pixel_bits: int) -> Configuration:
    """Widths of docs/numerics.md: A and B, and E without its low bits."""
    return _integer(17 + sub_pixel_bits, 35 + sub_pixel_bits)


def _step(sub_pixel_bits: int) -> Configuration:
    widths = {"StepBits": 17 + sub_pixel_bits, "SumBits": 35 + sub_pixel_bits}
    return Configuration("edge_integer_step", {}, widths)


def _float(top: str, number: dict[str, int], multipliers: int = 2, **more: str) -> Configuration:
    return Configuration(top, {}, {**number, **more}, multipliers)


# By the name of the arithmetic in the study's JSON; several arithmetics may evaluate alike. Of depth, `anchor:` is
# needed once for a square of pixels.
EDGES = {
    "exact_integer": _fixed(24),
    "fixed_8": _fixed(8),
    "fixed_6": _fixed(6),
    "fixed_4": _fixed(4),
    "exact_integer by increments": _step(24),
    "fixed_8 by increments": _step(8),
    "fixed_6 by increments": _step(6),
    "fixed_4 by increments": _step(4),
    "normalised": _integer(32, 32),
    "float_difference": _float("edge_float", FLOAT32),
    "float_vertex": _float("edge_float", FLOAT32, FromVertex="1'b1"),
    "float_increments": _float("edge_float_step", FLOAT32, 0),
    "float_epsilon": _float("edge_float", FLOAT32, HasEpsilon="1'b1"),
    "double": _float("edge_float", DOUBLE),
}
PLANE_BITS = (24, 28, 31, 32, 36, 40, 48, 56, 63)
WEIGHT_BITS = (16, 20, 24, 28, 32, 36)
DEPTHS = {
    "plane_float32": _float("depth_float", FLOAT32),
    "plane_double": _float("depth_float", DOUBLE),
    **{
        f"plane_{bits}": Configuration("depth_word_sample", {}, {"Bits": bits}, 2) for bits in PLANE_BITS
    },
    **{
        f"anchor: plane_{bits}": Configuration("depth_word_anchor", {}, {"Bits": bits}, 2)
        for bits in PLANE_BITS
    },
    **{
        f"barycentric_{bits}": Configuration("depth_weights", {}, {"Width": bits}, 4)
        for bits in WEIGHT_BITS
    },
}

# The machine's own, for all formats and pipelined: 192 edges of a tile; a sample; a tile with four samples; a sample.
BUILT = {
    "edge_evaluator": ("edge_evaluator", Configuration("edge_evaluator", {"TILE_SIZE": 8, "SUB_PIXEL_BITS": 8})),
    "plane_sample": ("early_z_parts", Configuration("plane_sample")),
    "depth_plane": ("early_z_parts", Configuration("depth_plane", {}, {"Quads": 1}, TILE_MULTIPLIERS)),
    "barycentric_sample": (
        "early_z_parts",
        Configuration("barycentric_sample", multipliers=SAMPLE_MULTIPLIERS),
    ),
}

STUDY = Unit("study", ("study/study",), (*EDGES.values(), *DEPTHS.values()))
# By name what Yosys reads, and what it makes of it.
NAMES = {name: (STUDY, configuration) for name, configuration in {**EDGES, **DEPTHS}.items()}
NAMES |= {name: (UNITS[unit], configuration) for name, (unit, configuration) in BUILT.items()}
