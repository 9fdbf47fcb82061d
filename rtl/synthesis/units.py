"""What is synthesized: the units, their configurations, and what the design states about each."""

import pathlib
from collections.abc import Mapping
from dataclasses import dataclass, field

RTL = pathlib.Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Configuration:
    """A module with its defines (HALFSPACE_ is put before them) and parameters."""

    top: str
    defines: Mapping[str, int] = field(default_factory=dict)
    parameters: Mapping[str, int] = field(default_factory=dict)
    multipliers: int = 0
    # The table has it. The others are only elaborated.
    measured: bool = True
    # Takes more than a few seconds to elaborate.
    long: bool = False
    # Every memory is read through a register, and becomes so many block RAMs of an ECP5.
    block_rams: int | None = None

    @property
    def label(self) -> str:
        words = [f"{key.lower()}={value}" for key, value in self.defines.items()]
        words += [f"{key}={value}" for key, value in self.parameters.items()]
        return " ".join(words) or "defaults"


@dataclass(frozen=True)
class Unit:
    """Its sources are in <list>.f, in the order of their dependencies."""

    name: str
    lists: tuple[str, ...]
    configurations: tuple[Configuration, ...]

    def files(self) -> list[str]:
        names = [name for files in self.lists for name in (RTL / f"{files}.f").read_text().split()]
        return [str(RTL / name) for name in dict.fromkeys(names)]


def _edge_evaluator() -> Unit:
    def of(tile, sub_pixel, measured=True, **parameters):
        defines = {"TILE_SIZE": tile, "SUB_PIXEL_BITS": sub_pixel}
        return Configuration("edge_evaluator", defines, parameters, measured=measured)

    return Unit(
        "edge_evaluator",
        ("edge_evaluator",),
        (
            of(4, 8),
            of(8, 8),
            of(16, 8),
            of(8, 4),
            of(8, 8, PipeStages=1),
            of(8, 8, PipeStages=3),
            of(4, 4, measured=False),
            of(16, 7, measured=False),
        ),
    )


def _walker(name, switch) -> Unit:
    def of(tile, block, sub_pixel=8, measured=True, multipliers=0, samples=1, **parameters):
        defines = {"TILE_SIZE": tile, "BLOCK_SIZE": block, "SUB_PIXEL_BITS": sub_pixel}
        defines |= {"SAMPLES": samples} if samples != 1 else {}
        return Configuration(name, defines, parameters, multipliers, measured=measured)

    def walk(levels, order, measured=True, **parameters):
        # Edges, and the plane, jump by products in x and y.
        jumps = levels == 3 or order > 3
        values = 4 if "HiZ" in parameters else 3
        return of(
            8, 32, measured=measured, multipliers=2 * values * jumps, Levels=levels, Order=order, **parameters
        )

    return Unit(
        name,
        (name,),
        (
            of(4, 32),
            of(8, 32),
            of(16, 32),
            of(8, 16),
            of(8, 64),
            of(8, 32, **{switch: "1'b0"}),
            *(
                (
                    of(8, 32, HiZ="1'b1"),
                    of(8, 32, SampleReject="1'b1"),
                    *(walk(1, order) for order in range(6)),
                    *(walk(2, order) for order in range(1, 6)),
                    *(walk(3, order) for order in (0, 1, 4, 5)),
                    walk(1, 3, measured=False, HiZ="1'b1"),
                    walk(3, 5, measured=False, HiZ="1'b1", SampleReject="1'b1"),
                )
                if name == "block_walker"
                else tuple(of(8, 32, Order=order) for order in (1, 2, 3))
            ),
            *(of(8, 32, samples=samples) for samples in (2, 4, 8, 16)),
            of(8, 32, 4, False),
            of(4, 8, 5, False, FifoDepth=2),
            of(16, 64, 6, False, FifoDepth=8),
        ),
    )


def _hi_z() -> Unit:
    def of(tile, block, parts=1, measured=True, **parameters):
        defines = {"TILE_SIZE": tile, "BLOCK_SIZE": block}
        defines |= {"Z_PARTS": parts} if parts != 1 else {}
        # Of 9 x 10 bits (blocks of 32): block_y times the blocks in a row.
        return Configuration("hi_z", defines, parameters, 1, measured=measured, long=parts == 4)

    return Unit(
        "hi_z",
        ("hi_z",),
        (
            of(8, 32),
            of(8, 32, Bits=4),
            of(8, 32, Lag=32),
            of(8, 16),
            of(8, 32, 4, False, Bits=16),
            of(4, 8, 4, False, Bits=32, Lag=1, FifoDepth=4, MemoryBlocks=2, ClearBlocks=1),
            of(16, 64, 2, False, FifoDepth=16, MemoryBlocks=5000, ClearBlocks=1024),
        ),
    )


def _quad_generator() -> Unit:
    def of(tile, quads, measured=True, **parameters):
        defines = {"TILE_SIZE": tile, "QUAD_WIDTH": quads}
        return Configuration("quad_generator", defines, parameters, measured=measured)

    return Unit(
        "quad_generator",
        ("quad_generator",),
        (
            *(of(8, quads) for quads in (1, 2, 4, 8, 16)),
            of(4, 4),
            of(16, 4),
            of(16, 16, False, FifoDepth=64),
        ),
    )


PLANE, BARYCENTRIC = 0, 1  # the parameter Interpolator

SETUP_MULTIPLIERS = {
    # Two for 2A in setup_cull, four for E in setup_edges.
    BARYCENTRIC: 6,
    # And in setup_plane four for the numerators, and three in each step of the two divisions.
    PLANE: 6 + 4 + 2 * 5 * 3,
}


def _setup() -> Unit:
    def of(sub_pixel, interval, interpolator, measured=True, samples=1, **parameters):
        # setup_hi_z has two, line_edges one.
        hi_z = 2 if "HiZ" in parameters and interpolator == PLANE else 0
        lines = 1 if "ThinLines" in parameters else 0
        return Configuration(
            "setup",
            {"SUB_PIXEL_BITS": sub_pixel} | ({"SAMPLES": samples} if samples != 1 else {}),
            {"Interval": interval, "Interpolator": interpolator, **parameters},
            multipliers=SETUP_MULTIPLIERS[interpolator] + hi_z + lines,
            measured=measured,
            long=interpolator == PLANE,
        )

    return Unit(
        "setup",
        ("setup",),
        (
            *(of(8, interval, BARYCENTRIC) for interval in (1, 4, 16)),
            of(8, 1, PLANE),
            of(8, 1, PLANE, HiZ="1'b1"),
            of(8, 1, BARYCENTRIC, Conservative=1, Uncertainty=1),
            of(8, 1, PLANE, False, HiZ="1'b1", Conservative=2, Uncertainty=1),
            of(4, 1, BARYCENTRIC, False, Conservative=1, Uncertainty=7),
            of(8, 1, PLANE, False, ThinLines="1'b1"),
            # What it has more: these, and line_edges for setup_edges.
            Configuration("line_columns", {"SUB_PIXEL_BITS": 8}),
            Configuration("line_edges", {"SUB_PIXEL_BITS": 8}, multipliers=5),
            Configuration("setup_edges", {"SUB_PIXEL_BITS": 8}, multipliers=4),
            *(of(8, 1, BARYCENTRIC, samples=samples) for samples in (4, 16)),
            of(4, 1, BARYCENTRIC, False),
            of(5, 1, BARYCENTRIC, False, ThinLines="1'b1"),
            of(4, 1, PLANE, False),
            of(4, 1, PLANE, False, HiZ="1'b1"),
            of(5, 2, BARYCENTRIC, False, FifoDepth=2),
            of(6, 8, BARYCENTRIC, False, QueueDepth=2),
        ),
    )


# Of 32 x 32 bits: three weights, two unorm terms, one division of the float32 sum.
SAMPLE_MULTIPLIERS = 6
# Of 86 x 13 bits: two gradients times the halves of the way to the tile.
TILE_MULTIPLIERS = 4


def early_z_multipliers(test_width: int, interpolator: int) -> int:
    """Of all samples of a beat, or of the tile; and the one that numbers it: tile_y times the tiles in a row."""
    return (TILE_MULTIPLIERS if interpolator == PLANE else 4 * test_width * SAMPLE_MULTIPLIERS) + 1


def _early_z() -> Unit:
    def whole(test_width, interpolator, measured=True, defines=None, long=False, **parameters):
        return Configuration(
            "early_z",
            {"TEST_WIDTH": test_width, **(defines or {})},
            {"Interpolator": interpolator, **parameters},
            multipliers=early_z_multipliers(test_width, interpolator),
            measured=measured,
            long=long,
        )

    least = {"TILE_SIZE": 4, "SUB_PIXEL_BITS": 5, "QUAD_WIDTH": 1}
    parts = {"QUAD_WIDTH": 8, "Z_PARTS": 4, "SUB_PIXEL_BITS": 6}
    return Unit(
        "early_z",
        ("early_z",),
        (
            whole(1, BARYCENTRIC),
            whole(1, BARYCENTRIC, Conservative=1, Uncertainty=1),
            whole(1, PLANE),
            whole(4, PLANE),
            whole(4, PLANE, long=True, HiZ="1'b1"),
            whole(4, PLANE, long=True, Compression="1'b1"),
            whole(4, PLANE, long=True, LateQueue=16),
            whole(4, BARYCENTRIC, False, long=True),
            whole(2, BARYCENTRIC, False, parts, True, Lines=32, Ways=1, ReadBytes=4, WriteBytes=4),
            whole(1, PLANE, False, least, True, Lines=1, Ways=1, ReadBytes=1, WriteBytes=1),
            whole(1, PLANE, False, long=True, HiZ="1'b1"),
            whole(1, PLANE, False, long=True, HiZ="1'b1", LateQueue=16),
            whole(2, PLANE, False, parts, True, Lines=32, Ways=1, ReadBytes=4, WriteBytes=4, LateQueue=1),
        ),
    )


def _early_z_parts() -> Unit:
    """Modules of early_z on their own: what bounds it, and what grows with what."""
    return Unit(
        "early_z_parts",
        ("early_z",),
        (
            Configuration("barycentric_sample", multipliers=SAMPLE_MULTIPLIERS),
            Configuration("barycentric_sample", {}, {"Conservative": 1}, SAMPLE_MULTIPLIERS),
            Configuration("plane_sample"),
            Configuration("inner_coverage", {"TEST_WIDTH": 1}, {"Uncertainty": 1}),
            *(Configuration("depth_plane", {}, {"Quads": quads}, TILE_MULTIPLIERS) for quads in (1, 4)),
            *(
                Configuration("depth_plane", {"SAMPLES": samples}, {"Quads": 1}, TILE_MULTIPLIERS)
                for samples in (4, 16)
            ),
            *(Configuration("z_lookup", {}, {"Lines": lines}, 1) for lines in (32, 128, 512)),
            *(Configuration("z_test", {"TEST_WIDTH": width}) for width in (1, 4)),
            Configuration("z_test", {"TEST_WIDTH": 1}, {"Lines": 32}),
            *(Configuration("z_extremes", {"TILE_SIZE": tile}) for tile in (8, 16)),
            Configuration("z_late_writes", {}, {"Queue": 16}),
        ),
    )


def _z_codec() -> Unit:
    def of(top, tile, parts, measured=True):
        defines = {"TILE_SIZE": tile, "Z_PARTS": parts}
        return Configuration(top, defines, measured=measured, long=tile == 16 and parts != 4)

    return Unit(
        "z_codec",
        ("z_codec",),
        tuple(
            configuration
            for top in ("z_encoder", "z_decoder")
            for configuration in (
                of(top, 8, 1),
                of(top, 4, 1),
                of(top, 8, 4),
                of(top, 4, 2, False),
                of(top, 8, 2, False),
                of(top, 16, 1, False),
                of(top, 16, 2, False),
                of(top, 16, 4, False),
            )
        ),
    )


def _interpolator() -> Unit:
    # For each of four pixels three products with 1/w and two with the reciprocal; for each component of each two rises.
    def of(bits, **more):
        return Configuration("interpolator", {}, {"Bits": bits}, 4 * (3 + 2) + 16 * 2, **more)

    return Unit(
        "interpolator",
        ("interpolator",),
        (
            of(24, measured=False),
            of(8, measured=False),
            Configuration("perspective_weights", {}, {"Bits": 24}, 5),
            Configuration("perspective_weights", {}, {"Bits": 16}, 5),
            Configuration("perspective_weights", {}, {"Bits": 8}, 5),
            Configuration("delay_memory", {}, {"Width": 388, "Cycles": 24}),
        ),
    )


def _memories() -> Unit:
    """What has to become block RAM, as the default machine has it."""
    return Unit(
        "memories",
        ("early_z", "quad_generator"),
        (
            Configuration("z_bank", {}, {"Lines": 128}, block_rams=4),
            Configuration("sync_ram", {}, {"Width": 464, "Depth": 256}, block_rams=13),
            Configuration("memory_fifo", {}, {"Width": 133, "Slots": 64}, block_rams=4),
            Configuration("z_late_writes", {"TEST_WIDTH": 1}, {"Queue": 16}, measured=False, block_rams=4),
        ),
    )



def _raster_pipeline() -> Unit:
    """All units and their counters: only elaborated. Its parts are measured."""

    def of(test_width, interpolator, **more):
        multipliers = SETUP_MULTIPLIERS[interpolator] + early_z_multipliers(test_width, interpolator)
        return Configuration(
            "raster_pipeline",
            {"TEST_WIDTH": test_width},
            {"Interpolator": interpolator},
            multipliers,
            measured=False,
            **more,
        )

    return Unit(
        "raster_pipeline",
        (*sorted(path.stem for path in RTL.glob("*.f") if path.stem != "raster_pipeline"), "raster_pipeline"),
        (of(1, BARYCENTRIC), of(4, PLANE, long=True), of(4, BARYCENTRIC, long=True)),
    )


UNITS = {
    unit.name: unit
    for unit in (
        _edge_evaluator(),
        _walker("block_walker", "TrivialReject"),
        _walker("tile_walker", "TrivialAccept"),
        _hi_z(),
        _quad_generator(),
        _setup(),
        _early_z(),
        _early_z_parts(),
        _z_codec(),
        _interpolator(),
        _memories(),
        _raster_pipeline(),
    )
}
