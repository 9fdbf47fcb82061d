"""The walks that `make study-traversal` compares, and how its result is read."""

import pathlib

RESULT = pathlib.Path(__file__).resolve().parent.parent / "out/traversal/traversal.json"
SCHEMA = ("halfspace-traversal", 1)
CELLS = {1: "tiles", 2: "blocks", 3: "superblocks"}
ORDERS = ("raster", "boustrophedonic", "backtracking", "zigzag", "morton", "hilbert")
LED = ("backtracking", "zigzag")
TILE_SIZES = (4, 8, 16)
# {metric: (title, text of a number)}
METRICS = {
    "steps": ("steps for a tile job", lambda value: f"{value:.2f}"),
    "cycles": ("cycles", lambda value: f"{value:,.0f}"),
    "misses": ("misses of the z cache", lambda value: f"{value:,.0f}"),
    "bytes": ("bytes of depth that memory moves", lambda value: f"{value:,.0f}"),
}


def walks():
    """[(levels, order)] of all that the machine has."""
    return [(levels, order) for levels in CELLS for order in ORDERS if levels != 3 or order not in LED]


def name_of(levels, order):
    return f"{CELLS[levels]}, {order}"


def settings_of(levels, order):
    """Of a curve or back and forth the tiles of a block too."""
    tiles = order if levels != 1 and order not in LED else "raster"
    return [f"block_walker.levels={levels}", f"block_walker.order={order}", f"tile_walker.order={tiles}"]
