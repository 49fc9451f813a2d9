# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
import os
import warnings

import numpy as np
import pytest

import ridgeway
from ridgeway import FREE, OCCUPIED, UNKNOWN, OccupancyMap


def random_states(seed, shape=(19, 26, 13)):
    return np.random.default_rng(seed).integers(0, 3, shape).astype(np.uint8)


def trimmed(states):
    """What a map keeps of an array: the box around its known voxels, and where that begins."""
    known = np.argwhere(states != UNKNOWN)
    low, high = known.min(0), known.max(0) + 1
    return states[tuple(slice(a, b) for a, b in zip(low, high))], low


@pytest.mark.parametrize("seed", range(8))
def test_states_come_back_as_they_went_in(seed):
    states = random_states(seed)
    if seed % 2:  # margins that are not known, blocks that hold nothing
        states[:5] = UNKNOWN
        states[:, :, 9:] = UNKNOWN
    grid = OccupancyMap.from_numpy(states, 0.25, (-1.0, 0.5, 12.25)).to_numpy()
    expected, low = trimmed(states)
    assert np.array_equal(grid.values, expected)
    assert grid.voxel_size == 0.25
    assert np.allclose(grid.origin, np.array([-1.0, 0.5, 12.25]) + 0.25 * low, atol=1e-12)
    again = OccupancyMap.from_numpy(*grid).to_numpy()
    assert np.array_equal(again.values, grid.values) and again.origin == grid.origin


def test_an_array_of_two_axes_is_a_planar_map_and_comes_back_as_one():
    states = random_states(9)[:, :, 0]
    grid = OccupancyMap.from_numpy(states, 0.25, (-1.0, 0.5, 2.25))
    assert grid.planar
    dense = grid.to_numpy()
    expected, low = trimmed(states)
    assert np.array_equal(dense.values, expected)
    assert np.allclose(dense.origin, (-1.0 + 0.25 * low[0], 0.5 + 0.25 * low[1], 2.25), atol=1e-12)
    again = OccupancyMap.from_numpy(*dense)
    assert again.planar and again.to_numpy().origin == dense.origin
    assert np.array_equal(again.to_numpy().values, dense.values)
    part = grid.to_numpy(((0.0, 1.0, -9.0), (2.0, 3.5, 99.0))).values  # whatever the heights
    assert np.array_equal(part, states[4:12, 2:12])
    assert np.array_equal(OccupancyMap.from_numpy(states.T[::-1], 0.25).to_numpy().values, trimmed(states.T[::-1])[0])
    bad = states.astype(int)
    bad[3, 4] = 7
    with pytest.raises(ValueError, match=r"states\[3, 4\]: is 7"):
        OccupancyMap.from_numpy(bad, 0.25)
    with pytest.raises(ValueError, match="states: has no voxel that is known"):
        OccupancyMap.from_numpy(np.zeros((4, 5), np.uint8), 0.25)
    for shape in ((4,), (0, 5), (2, 3, 4, 5)):
        with pytest.raises(ValueError, match="states: "):
            OccupancyMap.from_numpy(np.ones(shape, np.uint8), 0.25)


def reordered(states):
    """The same array in every way that memory can hold it."""
    odd = np.zeros(states.size + 1, np.uint8)[1:].reshape(states.shape)
    odd[...] = states
    wide = np.zeros(tuple(2 * n for n in states.shape), np.uint8)
    wide[::2, ::2, ::2] = states
    read_only = states.copy()
    read_only.flags.writeable = False
    return {
        "fortran": np.asfortranarray(states),
        "transposed": np.ascontiguousarray(states.transpose(2, 0, 1)).transpose(1, 2, 0),
        "reversed": np.ascontiguousarray(states[::-1, :, ::-1])[::-1, :, ::-1],
        "strided": wide[::2, ::2, ::2],
        "unaligned": odd,
        "read-only": read_only,
        "int8": states.astype(np.int8),
        "int32": states.astype(np.int32),
        "int64": np.asfortranarray(states.astype(np.int64)),
        "subclass": np.ma.masked_array(states),
    }


@pytest.mark.parametrize("name", reordered(random_states(3)))
def test_memory_order_does_not_matter(name):
    states = random_states(3)
    array = reordered(states)[name]
    assert np.array_equal(OccupancyMap.from_numpy(array, 0.1).to_numpy().values, trimmed(states)[0])


def test_zeros_and_ones_are_told_apart_from_free_and_occupied():
    grid = np.zeros((6, 5, 4), np.uint8)
    grid[2] = 1
    with pytest.warns(UserWarning, match="holds zeros and ones"):
        assert OccupancyMap.from_numpy(grid, 0.1).counts["occupied"] == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert OccupancyMap.from_numpy(grid.astype(bool), 0.1).counts["occupied"] == 20
        grid[0, 0, 0] = 2
        OccupancyMap.from_numpy(grid, 0.1)
        OccupancyMap.from_numpy(np.ones((6, 5, 4), int), 0.1)


def test_unaligned_floats_are_read():
    raw = np.zeros(4 * 5 * 6 * 8 + 1, np.uint8)
    odd = raw[1:].view(np.float64).reshape(4, 5, 6)
    odd[...] = 0.1
    odd[3, 4, 5] = 0.9
    assert not odd.flags.aligned
    assert OccupancyMap.from_numpy(odd, 0.1).counts["occupied"] == 1


def test_whole_numbers_of_any_width_are_states():
    states = random_states(4)
    for kind in (np.uint8, np.int8, np.uint16, np.int16, np.uint32, np.int32, np.uint64, np.int64):
        values = OccupancyMap.from_numpy(states.astype(kind), 0.1).to_numpy().values
        assert np.array_equal(values, trimmed(states)[0]), kind


def test_truth_values_and_probabilities():
    truth = np.zeros((3, 4, 5), bool)
    truth[1, 2, 3] = True
    states = OccupancyMap.from_numpy(truth, 0.1).to_numpy().values
    assert np.array_equal(states, np.where(truth, OCCUPIED, FREE))
    for dtype in (np.float32, np.float64):
        chance = np.array([[[0.0, 0.3, 0.5, 0.6, 1.0]]], dtype)
        states = OccupancyMap.from_numpy(chance, 0.1).to_numpy().values
        assert states.ravel().tolist() == [FREE, FREE, UNKNOWN, OCCUPIED, OCCUPIED]
        strict = OccupancyMap.from_numpy(chance, 0.1, free_below=0.2, occupied_above=0.7)
        assert strict.to_numpy().values.ravel().tolist() == [FREE, UNKNOWN, UNKNOWN, UNKNOWN, OCCUPIED]


@pytest.mark.parametrize(
    "make, error, words",
    [
        (lambda: OccupancyMap.from_numpy([[[1]]], 0.1), TypeError, "states: expected an .nx, ny, nz. array"),
        (lambda: OccupancyMap.from_numpy(np.zeros(3), 0.1), ValueError, r"states: .*shape \(3,\)"),
        (lambda: OccupancyMap.from_numpy(np.broadcast_to(np.uint8(1), (10**5,) * 3), 0.1), ValueError, "states: .*1e11"),
        (lambda: OccupancyMap.from_numpy(np.zeros((2, 2, 2), complex), 0.1), TypeError, "states: .*complex"),
        (lambda: OccupancyMap.from_numpy(np.zeros((2, 2, 2), object), 0.1), TypeError, "states: .*object"),
        (lambda: OccupancyMap.from_numpy(np.zeros((2, 2, 2), ">f8"), 0.1), TypeError, "states: .*byte order"),
        (lambda: OccupancyMap.from_numpy(np.full((2, 2, 2), 3), 0.1), ValueError, r"states\[0, 0, 0\]: is 3"),
        (lambda: OccupancyMap.from_numpy(np.full((2, 2, 2), -1), 0.1), ValueError, r"states\[0, 0, 0\]: is -1"),
        (lambda: OccupancyMap.from_numpy(np.full((2, 2, 2), np.nan), 0.1), ValueError, r"states\[0, 0, 0\]: is nan"),
        (lambda: OccupancyMap.from_numpy(np.full((2, 2, 2), 1.5), 0.1), ValueError, r"is 1.5.*probabilities"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), 0), ValueError, "voxel_size"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), np.nan), ValueError, "voxel_size"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), "0.1"), TypeError, "voxel_size: expected a number"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), 0.1, (0.04, 0, 0)), ValueError, "origin: .*nearest"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), 0.1, (0, 0)), ValueError, "origin: .*three numbers"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), 0.1, (1e300, 0, 0)), ValueError, "origin"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2), int), 0.1, (np.inf, 0, 0)), ValueError, "origin"),
        (lambda: OccupancyMap.from_numpy(np.ones((2, 2, 2)), 0.1, free_below=0.9), ValueError, "free_below"),
        (lambda: OccupancyMap.from_points(np.ones((2, 2)), 0.1, (0, 0, 0, 1, 1, 1)), ValueError, r"points: .*\(N, 3\)"),
        (lambda: OccupancyMap.from_points([["a", "b", "c"]], 0.1, (0, 0, 0, 1, 1, 1)), TypeError, "points"),
        (lambda: OccupancyMap.from_points(np.ones((2, 3)), 0.1, (0, 0, 0)), ValueError, "bounds: .*two corners"),
        (lambda: OccupancyMap.from_points(np.ones((2, 3)), 0.1, (1, 1, 1, 0, 0, 0)), ValueError, "bounds"),
        (lambda: ridgeway.load_map("no such file.bt"), ValueError, "no such file.bt"),
        (lambda: ridgeway.load_map(3), TypeError, "path: expected a path"),
        (lambda: ridgeway.load_map("a.bt", voxel_sise=1), TypeError, "did you mean 'voxel_size'"),
    ],
)
def test_bad_input_names_argument_and_expectation(make, error, words):
    with pytest.raises(error, match=words):
        make()


def test_input_errors_have_parts():
    with pytest.raises(ridgeway.InputError) as caught:
        OccupancyMap.from_numpy(np.full((2, 2, 2), 3), 0.1)
    assert caught.value.where == "states[0, 0, 0]"
    assert caught.value.problem == "is 3"
    assert "2 (occupied)" in caught.value.remedy
    assert isinstance(caught.value, ValueError)


def test_the_first_bad_value_is_named_for_any_number_of_threads():
    states = np.ones((40, 40, 40), np.uint8)
    states[7, 3, 30] = 9
    states[7, 30, 1] = 8
    states[39, 0, 0] = 7
    with pytest.raises(ValueError, match=r"states\[7, 3, 30\]: is 9"):
        OccupancyMap.from_numpy(states, 0.1)


def test_empty_arrays_and_unknown_ones_hold_nothing():
    for shape in [(0, 4, 4), (4, 0, 4), (4, 4, 0)]:
        assert OccupancyMap.from_numpy(np.zeros(shape, np.uint8), 0.1).bounds is None
    nothing = OccupancyMap.from_numpy(np.zeros((9, 9, 9), np.uint8), 0.1)
    assert nothing.bounds is None and nothing.to_numpy().values.shape == (0, 0, 0)
    with pytest.raises(ValueError, match="map: has no free space"):
        ridgeway.build(nothing)


def test_block_views_are_the_map_and_cannot_be_written():
    states = random_states(5, (24, 16, 8))
    states[0, 0, 0] = FREE
    states[:, 0, 0] = states[0, :, 0] = states[0, 0, :] = FREE
    grid = OccupancyMap.from_numpy(states, 0.5)
    blocks, corners = grid.block_states, grid.block_corners
    assert blocks.shape == (6, 8, 8, 8) and not blocks.flags.writeable and not blocks.flags.owndata
    for block, corner in zip(blocks, corners):
        x, y, z = np.rint(corner / 0.5).astype(int)
        assert np.array_equal(block, states[x : x + 8, y : y + 8, z : z + 8])
    with pytest.raises(ValueError):
        blocks[0, 0, 0, 0] = 1
    assert np.shares_memory(blocks, grid.block_states)
    del grid  # the view keeps the map alive
    assert blocks[0, 0, 0, 0] == FREE


def test_dense_slices_have_bounds():
    states = random_states(6)
    states[0, 0, 0] = states[-1, -1, -1] = FREE
    grid = OccupancyMap.from_numpy(states, 0.1)
    part = grid.to_numpy(((0.2, 0.3, 0.1), (0.7, 1.1, 0.5)))
    assert np.array_equal(part.values, states[2:7, 3:11, 1:5])
    beyond = grid.to_numpy(((-0.2, 0, 0), (0.1, 0.1, 0.1))).values
    assert beyond.ravel().tolist() == [UNKNOWN, UNKNOWN, states[0, 0, 0]]
    layer = grid.to_numpy(((-np.inf, -np.inf, 0.4), (np.inf, np.inf, 0.5))).values
    assert np.array_equal(layer[:, :, 0], states[:, :, 4])
    with pytest.raises(ValueError, match="bounds"):
        grid.to_numpy(((0, 0, 0), (1e7, 1e7, 1e7)))


def test_state_at_points_and_edits(rooms):
    grid = OccupancyMap.from_numpy(rooms, 0.1)
    found = grid.state_at([[0.05, 0.05, 0.05], [1.0, 1.0, 1.0], [1e30, 0, 0], [-5, 0, 0]])
    assert found.tolist() == [OCCUPIED, FREE, UNKNOWN, UNKNOWN]
    shut = grid.with_no_fly([((3.0, 1.0, 0.0), (3.4, 3.0, 2.5))])
    assert shut.state_at([[3.15, 2.2, 1.0]]).tolist() == [OCCUPIED]
    assert grid.state_at([[3.15, 2.2, 1.0]]).tolist() == [FREE]  # which stays as it was
    assert grid.resampled(0.2).voxel_size == 0.2
    assert grid.cropped(((0, 0, 0), (2, 2, 2))).bounds == ((0, 0, 0), (2, 2, 2))
    assert grid.flattened(0.5, 1.5).planar
    turn = np.eye(4)
    turn[:3, 3] = 1.0
    assert np.allclose(grid.transformed(turn).bounds[0], (1, 1, 1), atol=0.11)
    with pytest.raises(ValueError, match="transform: .*rotation"):
        grid.transformed(2 * np.diag([1, 1, 1, 0.5]))
    with pytest.raises(ValueError, match=r"transform: .*\(4, 4\)"):
        grid.transformed(np.eye(3))


def test_points_make_a_map():
    points = np.array([[0.05, 0.05, 0.05], [0.95, 0.95, 0.95], [np.nan, 0, 0]])
    with pytest.warns(UserWarning, match="points: 1 of 3 points were skipped"):
        grid = OccupancyMap.from_points(points, 0.1, ((0, 0, 0), (1, 1, 1)))
    assert grid.counts == {"free": 998, "occupied": 2, "unknown": grid.counts["unknown"]}
    assert "voxel_size=0.1" in repr(grid)
    with pytest.warns(UserWarning, match="points: 1 of 2 points lie outside of the bounds"):
        OccupancyMap.from_points([[0.5, 0.5, 0.5], [500, 500, 500]], 0.1, ((0, 0, 0), (1, 1, 1)))


def test_wrong_calls_are_told_in_words_of_python(roadmap):
    for call, words in (
        (lambda: OccupancyMap.from_points(np.zeros((1, 3)), 0.1),
         "OccupancyMap.from_points(): missing a required argument: 'bounds'; it is "
         "OccupancyMap.from_points(points, voxel_size, bounds, transform=None)"),
        (lambda: roadmap.plan((0, 0, 1)), "Roadmap.plan(): missing a required argument: 'goal'"),
        (lambda: ridgeway.build("a.bt", 0.3), "build(): too many positional arguments; it is build(map, ...)"),
        (lambda: ridgeway.compute_skeleton(roadmap), "compute_skeleton(): cannot take Roadmap; it is compute_skeleton(esdf,"),
        (lambda: OccupancyMap(np.zeros((2, 2, 2))),
         "OccupancyMap: is not made by calling it; use OccupancyMap.from_numpy or OccupancyMap.from_points"),
        (lambda: ridgeway.SparseGraph(), "SparseGraph: is not made by calling it"),
    ):
        with pytest.raises(TypeError) as error:
            call()
        assert str(error.value).startswith(words)


def test_bounds_are_printed_without_what_sums_leave():
    cloud = [[0.05, 0.05, 0.05], [6.55, 6.55, 3.35]]
    assert "bounds=((0.0, 0.0, 0.0), (6.6, 6.6, 3.4))" in repr(
        OccupancyMap.from_points(cloud, 0.1, ((0, 0, 0), (6.6, 6.6, 3.4))))


def test_names_of_files_are_any_bytes(tmp_path):
    bare = OccupancyMap.from_numpy(np.full((20, 20, 20), FREE, np.uint8), 0.1)
    name = b"r\xe4ume.ridge"  # Latin-1: no UTF-8
    path = os.path.join(os.fsencode(tmp_path), name)
    ridgeway.build(bare, min_clearance=0.2).save(path)
    assert os.path.exists(path)
    points = os.path.join(os.fsencode(tmp_path), b"r\xe4ume.xyz")
    with open(points, "w") as file:
        file.writelines(f"{x} {y} 0\n" for x in range(5) for y in range(5))
    cloud = ridgeway.load_map(points, voxel_size=1.0, bounds=((0, 0, 0), (5, 5, 5)))
    assert os.fsencode(cloud.source) == b"r\xe4ume.xyz"
    assert "source" in repr(cloud)
    roadmap = ridgeway.build(cloud, min_clearance=1.0)
    assert os.fsencode(roadmap.source) == b"r\xe4ume.xyz" and "source" in repr(roadmap)
    roadmap.save(path)
    assert ridgeway.load(path).source == "r\ufffdume.xyz"  # files hold UTF-8
    with pytest.raises(ridgeway.InputError, match="No such file") as error:
        ridgeway.load(b"nowhere\xe4.ridge")
    assert os.fsencode(error.value.where) == b"nowhere\xe4.ridge"


def test_half_a_surrogate_pair_is_no_text():
    bare = OccupancyMap.from_numpy(np.full((20, 20, 20), FREE, np.uint8), 0.1)
    with pytest.raises(ridgeway.InputError, match="unknown.*surrogate"):
        ridgeway.build(bare, min_clearance=0.2, unknown="\ud800")
    for call in (ridgeway.build, ridgeway.load_map):
        with pytest.raises(ridgeway.InputError, match="surrogate"):
            call(bare, **{"\ud800": 1})


def test_texts_of_errors_are_cut_between_characters():
    bare = OccupancyMap.from_numpy(np.full((20, 20, 20), FREE, np.uint8), 0.1)
    for text in ("\u00e9" * 100, "a" + "\u00e9" * 100, "\u20ac" * 100):
        with pytest.raises(TypeError, match="min_clearance: expected a number"):
            ridgeway.build(bare, min_clearance=text)
