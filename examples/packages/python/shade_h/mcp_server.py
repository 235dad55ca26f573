"""An MCP server that lets a language model see the parts that it makes: pictures, and what is in
them in words.  Register `shade-h-mcp`, or `python3 -m shade_h.mcp_server`, with a client; messages are
lines of JSON."""
from __future__ import annotations

import base64
import json
import sys
from typing import Any

import shade_h
from shade_h.__main__ import viewpoint
from shade_h.picture import Picture

TEXT = {"type": "string"}
MODEL = {"model": {**TEXT, "description": "path of an STL, OBJ, PLY, GLB or 3MF file"}}
VIEW = {"view": {**TEXT, "description": "front, right, back, left, top, bottom, iso, or 30,20: "
                                        "azimuth and elevation in degrees"}}


def render(model: str, view: str = "iso") -> Picture:
    """A picture of a part."""
    return shade_h.render(model, view=viewpoint(view), edges=True)


def sheet(model: str) -> Picture:
    """Front, right, top and iso of a part."""
    return shade_h.sheet([shade_h.load(model)])


def section(model: str, axis: str, at: float | None = None, view: str = "iso") -> Picture:
    """A part cut open at a plane, the cut hatched."""
    plane: Any = axis if at is None else (axis, float(at))
    return shade_h.render(model, view=viewpoint(view), edges=True, section=plane)


def compare(model: str, other: str, view: str = "iso") -> tuple[Picture, str]:
    """Where two parts look different."""
    scene = shade_h.Scene()
    scene.add(model)
    scene.add(other)
    camera = scene.fit(viewpoint(view))    # one for both, so that what is alike is in one place
    pictures = [shade_h.Scene() for _ in range(2)]
    for single, path in zip(pictures, (model, other)):
        single.add(path, edges=True)
    one, two = (single.render(camera) for single in pictures)
    apart = one.difference(two)
    two.rgba[apart > 16, :3] = 255, 0, 0
    return two, f"{(apart > 16).mean():.1%} of the pixels differ; they are red in {other}."


TOOLS: dict[str, tuple[Any, dict[str, Any], list[str]]] = {  # function, its arguments, those that it needs
    "render": (render, {**MODEL, **VIEW}, ["model"]),
    "sheet": (sheet, MODEL, ["model"]),
    "section": (section, {**MODEL, **VIEW, "axis": {"enum": ["x", "y", "z"]}, "at": {"type": "number"}},
                ["model", "axis"]),
    "compare": (compare, {**MODEL, **VIEW, "other": TEXT}, ["model", "other"])}


def call(name: str, arguments: dict[str, Any]) -> dict[str, Any]:
    """What a tool gives."""
    got = TOOLS[name][0](**arguments)
    picture, words = got if isinstance(got, tuple) else (got, got.report())
    data = base64.b64encode(picture.png()).decode()
    return {"content": [{"type": "text", "text": words},
                        {"type": "image", "data": data, "mimeType": "image/png"}]}


def answer(method: str, given: dict[str, Any]) -> dict[str, Any] | None:
    """The result of a method; None: there is no such method."""
    if method == "initialize":
        return {"protocolVersion": given.get("protocolVersion", "2025-06-18"),
                "capabilities": {"tools": {}},
                "serverInfo": {"name": "shade-h", "version": shade_h.__version__}}
    if method == "tools/list":
        return {"tools": [{"name": name, "description": tool.__doc__, "inputSchema": {
            "type": "object", "properties": takes, "required": needs}}
            for name, (tool, takes, needs) in TOOLS.items()]}
    if method == "tools/call" and isinstance(given.get("name"), str) and given["name"] in TOOLS:
        try:
            return call(given["name"], given.get("arguments") or {})
        except Exception as why:    # whatever arguments do: the client reads it and tries again
            return {"content": [{"type": "text", "text": str(why)}], "isError": True}
    return {} if method == "ping" else None


def told(line: str) -> dict[str, Any] | None:
    """The answer to a line; None to a notification."""
    number: Any = None
    result: dict[str, Any] | None = None
    try:
        asked = json.loads(line)
        number, method, given = asked.get("id"), asked.get("method"), asked.get("params") or {}
    except (ValueError, AttributeError, RecursionError):
        code, why = -32700, "no JSON of an object"
    else:
        if number is None:
            return None
        if not isinstance(number, (int, float, str)):
            number = None
        code, why = -32601, f"unknown: {method}"
        if not isinstance(method, str):
            code, why = -32600, "method must be a string"
        elif not isinstance(given, dict) or not isinstance(given.get("arguments") or {}, dict):
            code, why = -32602, "params and their arguments must be objects"
        else:
            result = answer(method, given)
    words: dict[str, Any] = {"error": {"code": code, "message": why}} if result is None else {"result": result}
    return {"jsonrpc": "2.0", "id": number, **words}


def main() -> None:
    """Answers standard input, line by line."""
    for line in sys.stdin:
        words = told(line)
        if words is not None:
            print(json.dumps(words), flush=True)


if __name__ == "__main__":
    main()
