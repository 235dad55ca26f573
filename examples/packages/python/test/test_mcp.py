"""The MCP server, by its protocol over a pipe."""
import base64
import io
import json
import subprocess
import sys

import numpy as np
import pytest
from shapes import box

import shade_h as shade


@pytest.fixture
def ask(tmp_path):
    for name, sides in (("a", (3, 2, 1)), ("b", (3, 2, 1.5))):
        vertices, faces = box(*sides)
        (tmp_path / f"{name}.obj").write_text(
            "".join("v {} {} {}\n".format(*p) for p in vertices.tolist()) +
            "".join("f {} {} {} {}\n".format(*f) for f in (faces + 1).tolist()), "utf-8")
    process = subprocess.Popen([sys.executable, "-m", "shade_h.mcp_server"], cwd=tmp_path, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)

    def send(method, number=1, **given):
        message = {"jsonrpc": "2.0", "method": method, "params": given}
        message.update({} if number is None else {"id": number})
        process.stdin.write(json.dumps(message) + "\n")
        process.stdin.flush()
        if number is None:
            return None
        told = json.loads(process.stdout.readline())
        assert told["jsonrpc"] == "2.0" and told["id"] == number
        return told

    send.process = process
    yield send
    process.stdin.close()
    assert process.wait(30) == 0
    process.stdout.close()


def picture_of(told):
    words, image = told["result"]["content"]
    assert image["mimeType"] == "image/png" and words["type"] == "text"
    return words["text"], shade.Picture.open(io.BytesIO(base64.b64decode(image["data"])))


def test_a_client_sees_parts(ask, tmp_path):
    start = ask("initialize", 0, protocolVersion="2025-06-18", capabilities={},
                clientInfo={"name": "test", "version": "1"})["result"]
    assert start["protocolVersion"] == "2025-06-18" and "tools" in start["capabilities"]
    ask("notifications/initialized", None)
    tools = {tool["name"]: tool for tool in ask("tools/list", "two")["result"]["tools"]}
    assert sorted(tools) == ["compare", "render", "section", "sheet"]
    for tool in tools.values():
        assert set(tool["inputSchema"]["required"]) <= set(tool["inputSchema"]["properties"])

    words, got = picture_of(ask("tools/call", 3, name="render",
                                arguments={"model": "a.obj", "view": "30,20"}))
    assert got == shade.render(tmp_path / "a.obj", view=(30, 20), edges=True)
    assert "Part 0: 12 triangles, 3 x 2 x 1" in words
    _, got = picture_of(ask("tools/call", 4, name="sheet", arguments={"model": "a.obj"}))
    assert got == shade.sheet([tmp_path / "a.obj"])
    _, got = picture_of(ask("tools/call", 5, name="section",
                            arguments={"model": "a.obj", "axis": "x", "at": 1}))
    assert got == shade.render(tmp_path / "a.obj", edges=True, section=("x", 1))
    words, got = picture_of(ask("tools/call", 6, name="compare",
                                arguments={"model": "a.obj", "other": "b.obj"}))
    red = (got.rgba == [255, 0, 0, 255]).all(2)
    assert f"{red.mean():.1%}" in words and 0.01 < red.mean() < 0.5
    words, got = picture_of(ask("tools/call", 7, name="compare",
                                arguments={"model": "a.obj", "other": "a.obj"}))
    assert words.startswith("0.0%") and not (got.rgba == [255, 0, 0, 255]).all(2).any()


def test_mistakes_are_told_and_the_server_goes_on(ask):
    for arguments in ({"model": "no.obj"}, {}, {"model": "a.obj", "wrong": 1}, {"model": 7},
                      {"model": "a.obj", "view": "behind"}, {"model": "a.obj", "view": "1,x"}):
        told = ask("tools/call", 1, name="render", arguments=arguments)["result"]
        assert told["isError"] and len(told["content"][0]["text"]) > 5
    assert ask("tools/call", 2, name="nothing")["error"]["code"] == -32601
    assert ask("resources/list", 3)["error"]["code"] == -32601
    assert ask("ping", 4)["result"] == {}
    ask.process.stdin.write("no JSON\n[]\n")
    ask.process.stdin.flush()
    for _ in range(2):
        told = json.loads(ask.process.stdout.readline())
        assert told["error"]["code"] == -32700 and told["id"] is None
    assert np.isfinite(len(ask("tools/list", 5)["result"]["tools"]))


@pytest.mark.parametrize("view", [None, 3, {}, [], [30], ["iso"], [1e999, 0], "nowhere", "1,2,3"])
def test_no_view_ends_the_server(ask, view):
    for name, more in (("render", {}), ("compare", {"other": "b.obj"}), ("section", {"axis": "x"})):
        told = ask("tools/call", 7, name=name, arguments={"model": "a.obj", "view": view, **more})
        assert told["result"]["isError"] is True and told["result"]["content"][0]["text"]
    one = picture_of(ask("tools/call", 8, name="render", arguments={"model": "a.obj", "view": [30, 20]}))[1]
    two = picture_of(ask("tools/call", 9, name="render", arguments={"model": "a.obj", "view": "30,20"}))[1]
    assert np.array_equal(one.rgba, two.rgba)
