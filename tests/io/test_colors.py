"""Colours of every form become the bytes that programs show."""

import numpy as np
import pytest

from pointchart import read_scan, write_mesh
from pointchart.io.colors import with_byte_colors

BYTES = np.array([[0, 128, 255], [17, 200, 3]], np.uint8)
FORMS = {
    "from 0 to 1": BYTES / 255.0,
    "single precision": (BYTES / 255.0).astype(np.float32),
    "whole numbers as text has them": BYTES.astype(float),
    "bytes": BYTES,
    "16 bits": BYTES.astype(np.uint16) * 257,
    "bytes in 16 bits": BYTES.astype(np.uint16),
    "signed": BYTES.astype(np.int64),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("names", [("red", "green", "blue"), ("R", "G", "B"), ("Rf", "Gf", "Bf")])
def test_every_form_of_a_colour_is_written_as_the_same_bytes(tmp_path, form, names):
    attributes = dict(zip(names, FORMS[form].T, strict=True)) | {"intensity": np.array([0.5, 0.25])}
    write_mesh(tmp_path / "m.ply", np.eye(3)[:2], np.empty((0, 3), int), attributes=attributes)
    written = read_scan(tmp_path / "m.ply").attributes
    assert list(written) == ["red", "green", "blue", "intensity"]
    for channel, values in zip(("red", "green", "blue"), BYTES.T, strict=True):
        assert written[channel].dtype == np.uint8
        np.testing.assert_array_equal(written[channel], values)


@pytest.mark.parametrize("channel", [[-1.0, 2.0], [0.5, 300.5], [np.nan, 1.0], [0.0, 70000.0]])
def test_what_is_no_colour_stays_as_it_is(channel):
    attributes = {"r": np.array(channel), "g": np.zeros(2), "b": np.zeros(2)}
    assert with_byte_colors(attributes) is attributes


def test_a_single_channel_is_no_colour():
    attributes = {"red": np.array([0.5, 1.0])}
    assert with_byte_colors(attributes) is attributes


def test_alpha_goes_with_the_colours():
    attributes = {name: np.array([0.0, 1.0]) for name in ("red", "green", "blue", "alpha")}
    for values in with_byte_colors(attributes).values():
        assert values.tolist() == [0, 255]


def test_black_and_white_light_is_light_and_bytes_near_black_are_bytes():
    light = {name: np.array([0.0, 1.0]) for name in "rgb"}
    dark = {name: np.array([0, 1], np.uint8) for name in "rgb"}
    assert with_byte_colors(light)["red"].tolist() == [0, 255]
    assert with_byte_colors(dark)["red"].tolist() == [0, 1]
