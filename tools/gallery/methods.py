"""The methods of the gallery, from methods.toml. Needs no other packages."""

import pathlib
import shlex
import tomllib
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILE = pathlib.Path(__file__).with_name("methods.toml")
PICTURES = ("shaded", "owners", "tests", "depth", "quads", "colors", "walk")
GROUP_KEYS = {"id", "title", "text", "page", "scene", "default", "detail", "picture", "rings", "options", "methods"}
METHOD_KEYS = {"id", "title", "scene", "detail", "picture", "rings", "options"}


class Window(NamedTuple):
    """What is magnified, in pixels of the frame."""

    x: int
    y: int
    width: int
    height: int


class Method(NamedTuple):
    id: str
    title: str
    picture: str  # one of PICTURES
    detail: Window
    rings: bool  # whether details mark what differs
    passes: int  # of which the median is the time of a frame
    command: tuple[str, ...]  # behind `halfspace run`, without where the result goes
    beside: tuple[str, ...]  # that of the group's default method on the same scene

    @property
    def picture_file(self):
        return f"{self.id}.{'svg' if self.picture == 'walk' else 'png'}"

    @property
    def detail_file(self):
        return f"{self.id}_detail.svg"


class Group(NamedTuple):
    id: str
    title: str
    text: str
    page: str
    default: str  # id of the method that the others are compared with
    methods: tuple[Method, ...]


class ListError(Exception):
    """methods.toml does not say what it should."""


def _window(text):
    try:
        x, y, size = text.split(",")
        return Window(int(x), int(y), *(int(side) for side in size.split("x", 1)))
    except (TypeError, ValueError):
        raise ListError(f"detail is '{text}'; legal: X,Y,WIDTHxHEIGHT") from None


def is_reference(command):
    return "--reference" in command


def _command(scene, *options):
    words = (scene["input"], scene["view"], *options)
    return tuple(word for part in words for word in shlex.split(part))


def _method(entry, group, default, scenes):
    unknown = entry.keys() - METHOD_KEYS
    if unknown:
        raise ListError(f"{entry.get('id')}: key '{min(unknown)}'; legal: {', '.join(sorted(METHOD_KEYS))}")
    both = {**group, **entry}
    if both["scene"] not in scenes:
        raise ListError(f"{entry['id']}: scene is '{both['scene']}'; legal: {', '.join(scenes)}")
    if both["picture"] not in PICTURES:
        raise ListError(f"{entry['id']}: picture is '{both['picture']}'; legal: {', '.join(PICTURES)}")
    scene = scenes[both["scene"]]
    return Method(
        id=entry["id"],
        title=entry["title"],
        picture=both["picture"],
        detail=_window(both["detail"]),
        rings=both.get("rings", True),
        passes=scene.get("passes", 101),
        command=_command(scene, group["options"], entry["options"]),
        beside=_command(scene, group["options"], default["options"]),
    )


def _group(entry, scenes):
    unknown = entry.keys() - GROUP_KEYS
    if unknown:
        raise ListError(f"{entry.get('id')}: key '{min(unknown)}'; legal: {', '.join(sorted(GROUP_KEYS))}")
    default = next((method for method in entry["methods"] if method["id"] == entry["default"]), None)
    if default is None:
        raise ListError(f"{entry['id']}: default is '{entry['default']}', which is none of its methods")
    methods = tuple(_method(method, entry, default, scenes) for method in entry["methods"])
    return Group(entry["id"], entry["title"], entry["text"].strip(), entry["page"], entry["default"], methods)


def load(file=FILE):
    """All groups, in order. Throws ListError."""
    with open(file, "rb") as text:
        data = tomllib.load(text)
    try:
        groups = tuple(_group(entry, data["scenes"]) for entry in data["groups"])
    except KeyError as missing:
        raise ListError(f"{file}: {missing} is missing") from None
    ids = [method.id for group in groups for method in group.methods]
    twice = {name for name in ids if ids.count(name) > 1}
    if twice:
        raise ListError(f"{file}: two methods are '{min(twice)}'")
    return groups


def command_line(method, options=""):
    """The one command of a method, as a reader types it."""
    return shlex.join(["halfspace", "run", *method.command]) + options
