"""A Renderer that is changed while other threads draw it, and far from the origin."""
import os
import threading

import numpy as np
import pytest
import shade_h as shade

EYE = shade.Camera.look_at((0, -6, 1.5), aspect=1.0)


def moved(x, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def drawn_while(change, draw, seconds=1.0):
    """Draws in two threads until a third has changed for so long; raises what any of them raised."""
    over, wrong, pictures = threading.Event(), [], [0]

    def run(call):
        try:
            while not over.is_set():
                call()
        except BaseException as error:    # told below
            wrong.append(error)
            over.set()

    def counted():
        draw()
        pictures[0] += 1

    threads = [threading.Thread(target=run, args=(call,)) for call in (counted, counted, change)]
    for thread in threads:
        thread.start()
    over.wait(seconds)
    over.set()
    for thread in threads:
        thread.join()
    assert not wrong, wrong
    assert pictures[0] > 10


@pytest.mark.parametrize("shadow", [None, [0]])
def test_a_picture_shows_all_of_a_change_or_nothing(shadow):
    made = shade.Renderer(40, 40)
    balls = [made.add("sphere", 0.4, at=(k - 1, 0, 0), color="red") for k in range(3)]
    made.add("plane", (3, 3), color="gray", pose=moved(0, 0, -1))
    made.light([shade.Light.directional((0, 1, -1))], (0.2, 0.2, 0.2), shadow=shadow)
    poses = {side: np.stack([moved(k - 1 + side, 0, 0) for k in range(3)]) for side in (0.0, 30.0)}
    known = set()
    for side in poses:
        made.poses(poses[side], balls)
        known.add(made.render(EYE).ids.tobytes())
    step = [0]

    def change():
        step[0] += 1
        made.poses(poses[30.0 * (step[0] % 2)], balls)

    def draw():
        assert made.render(EYE).ids.tobytes() in known

    drawn_while(change, draw)


def test_meshes_textures_and_objects_come_and_go_while_pictures_are_drawn():
    made = shade.Renderer(32, 32)
    cube = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    shape, texture = made.mesh(cube, faces), made.texture(np.full((4, 4, 3), 200, np.uint8))
    ball = made.add(shape, 0.5, texture=texture)
    sizes = set()
    for scale in (1.0, 1.5):
        made.update(shape, cube * scale)
        sizes.add(int((made.render(EYE).ids[..., 0] == ball).sum()))
    assert len(sizes) == 2
    step = [0]

    def change():
        step[0] += 1
        made.update(shape, cube * (1.0, 1.5)[step[0] % 2])
        made.update_texture(texture, np.full((4, 4, 3), step[0] % 256, np.uint8))
        made.light([shade.Light.directional((step[0] % 3, 1, -1))] * (step[0] % 4))
        (made.sky if step[0] % 2 else made.background)("#ff0000")
        extra = made.add(made.mesh(cube, faces), 0.1, at=(0, 40, 0))
        extra.remove()

    def draw():
        frame = made.render_batch([EYE, EYE], threads=1)
        for ids in frame.ids:
            assert int((ids[..., 0] == ball).sum()) in sizes
        assert np.array_equal(frame.color[0], frame.color[1])

    drawn_while(change, draw)


def test_poses_of_a_batch_are_those_of_the_objects_that_are_drawn():
    made = shade.Renderer(24, 24)
    for k in range(3):
        made.add("box", (0.3, 0.3, 0.3), at=(k - 1, 0, 0))
    poses = np.stack([np.stack([moved(k - 1, 0, z) for k in range(3)]) for z in (0.0, 1.0)])

    def change():
        made.add("sphere", 0.2, at=(0, 30, 0)).remove()

    def draw():
        try:
            frame = made.render_batch(EYE, poses)
        except shade.Error as error:    # there is a fourth object by now
            assert "poses" in str(error)
        else:
            assert {-1, 0, 1, 2} == set(np.unique(frame.ids[0][..., 0]))

    drawn_while(change, draw)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_fork_while_others_draw_and_change_goes_on():
    made = shade.Renderer(16, 16)
    ball = made.add("sphere", 0.5)
    over = threading.Event()

    def run(call):
        while not over.is_set():
            call()

    threads = [threading.Thread(target=run, args=(call,), daemon=True) for call in
               (lambda: made.render(EYE), lambda: made.change(ball, color="red"), lambda: made.pose(ball, np.eye(4)))]
    for thread in threads:
        thread.start()
    try:
        for _ in range(20):
            child = os.fork()
            if not child:
                os._exit(7 if made.add("box", (1, 1, 1)) == 1 and (made.render(EYE).ids == 1).any() else 1)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    finally:
        over.set()
        for thread in threads:
            thread.join()


@pytest.mark.parametrize("far", [(5e5, 4e6, 100.0), (0.0, 0.0, 6.4e6), (1e8, -1e8, 1e8)])
@pytest.mark.parametrize("shadow", [[], [0, 1]])
def test_a_scene_far_away_is_that_at_the_origin(far, shadow):
    far = np.round(np.array(far) / 1024) * 1024    # so that doubles add it exactly
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0.3], [-1, 1, 0], [0, 0, 0.75]])
    faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    frames = []
    for place in (np.zeros(3), far):
        made = shade.Renderer(60, 80)
        made.add("plane", color="gray", pose=moved(*place + (0, 0, -0.5)))
        made.add(made.mesh(corners + place, faces), color="orange")
        made.add(made.mesh(corners, faces), at=place + (2, 0, 0))
        made.add("sphere", 0.5, at=place + (-2, 0, 0.25), specular=0.5)
        made.light([shade.Light.directional((1, 1, -2)), shade.Light.spot(place + (0, -2, 4), (0, 0.5, -1), 0.9),
                    shade.Light.point(place + (0, 3, 2))], (0.1, 0.1, 0.1), shadow)
        eye = shade.Camera.look_at(place + (0.5, -5, 3), place, near=0.05, far=100)
        frames.append(made.render(eye, normals=True))
    near, away = frames
    assert (near.ids != away.ids).any(-1).sum() <= 2
    both = np.isfinite(near.depth) & np.isfinite(away.depth)
    assert np.abs(near.depth - away.depth)[both].max() < 2e-3 and both.sum() > 2000
    assert np.abs(near.color.astype(int) - away.color.astype(int)).max(-1).mean() < 0.1


def test_numbers_are_given_once_and_foreign_or_stale_ones_are_refused():
    made, other = shade.Renderer(8, 8), shade.Renderer(8, 8)
    ball, box = made.add("sphere", 1), made.add("box", (1, 1, 1))
    elsewhere, shape = other.add("sphere", 1), other.mesh(np.eye(3), [[0, 1, 2]])
    picture = other.texture(np.zeros((2, 2, 3), np.uint8))
    ball.remove()
    assert made.add("sphere", 1) == 2 and made.objects == [1, 2]
    for words, call in (("there is no object 0", lambda: made.pose(ball, np.eye(4))),
                        ("there is no object 0", lambda: ball.color),
                        ("object 0 is of another Renderer", lambda: made.remove(elsewhere)),
                        (r"numbers\[1\]: object 0 is of another", lambda: made.poses([np.eye(4)] * 2, [1, elsewhere])),
                        ("texture 0 is of another Renderer", lambda: made.change(box, texture=picture)),
                        ("shape must be of this renderer", lambda: made.add(shape)),
                        ("shape must be of this renderer", lambda: made.update(shape, np.eye(3))),
                        ("shape must be of this renderer", lambda: made.remove(shape))):
        with pytest.raises(shade.Error, match=words):
            call()
    made.clear()
    assert made.add("box", (1, 1, 1)) == 3


def test_an_object_has_its_pose_its_colour_and_its_end():
    made = shade.Renderer(24, 24)
    ball = made.add("sphere", 0.5, color="red")
    assert ball == 0 and [10, 20][ball] == 10 and isinstance(ball, int)
    ball.pose = 1.0, 2.0, 3.0
    assert np.array_equal(ball.pose, moved(1, 2, 3))
    turned = moved(0) @ np.diag([-1.0, -1, 1, 1])
    ball.pose = turned
    ball.color = "blue"
    assert np.array_equal(ball.pose, turned) and ball.color == "blue"
    seen = made.render(EYE).ids[..., 0] == ball
    assert seen.any()
    ball.show(False)
    assert not (made.render(EYE).ids[..., 0] == ball).any()
    ball.show()
    ball.change(size=0.25)
    assert 0 < (made.render(EYE).ids[..., 0] == ball).sum() < seen.sum()
    ball.remove()
    assert made.objects == []


def test_arrays_of_the_caller_stay_the_callers():
    made = shade.Renderer(48, 48)
    vertices = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    colors, color = np.full((4, 3), 0.5, np.float32), np.array([1.0, 0, 0])
    shape = made.mesh(vertices, faces, colors=colors)
    mesh = shade.Mesh(vertices, faces, color=colors)
    picture = shade.render(mesh, size=(32, 32)).png()
    wall = made.add(shape, color=color, two_sided=True)
    want = made.render(EYE)
    assert (want.ids[..., 0] == 0).sum() > 100
    for array in (faces, colors, color, vertices):
        array[:] = 0
    made.update(shape, [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    made.change(wall, shininess=3)
    got = made.render(EYE)
    assert np.array_equal(got.ids, want.ids) and np.array_equal(got.color, want.color)
    assert shade.render(mesh, size=(32, 32)).png() == picture
