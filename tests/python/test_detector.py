"""What can be asked of a detector without a point."""

import pathlib

import numpy as np
import pytest

import navjit


def test_volumes_and_materials_have_their_numbers(detector):
    assert [v.number for v in detector.volumes] == list(range(len(detector.volumes)))
    assert [m.number for m in detector.materials] == list(range(len(detector.materials)))
    assert detector.world in detector.volumes
    for volume in detector.volumes:
        assert detector.volume(volume.name) == volume
        assert volume.material == detector.materials[volume.material.number]
        assert len({volume, detector.volumes[volume.number]}) == 1
    lead = detector.material("Lead")
    assert lead.density == pytest.approx(11.35)
    assert lead.radiation_length == pytest.approx(5.61, rel=0.01)
    assert sum(fraction for _, fraction in lead.elements) == pytest.approx(1)


def test_touchables_add_up(detector):
    for volume in detector.volumes:
        assert volume.touchables in (
            0,  # not in the world's tree
            1 + sum(daughter.volume.touchables for daughter in volume.daughters),
        )
    assert detector.world.touchables == detector.touchables


def test_a_box_is_its_extent(detector):
    box = next(v for v in detector.volumes if v.solid_kind == "box")
    low, high = box.extent
    assert np.prod(high - low) == pytest.approx(box.capacity)


def test_paths_there_and_back(detector, runtime):
    states = runtime.locate(np.random.default_rng(1).uniform(-4000, 4000, size=(200, 3)))
    paths = detector.paths(states)
    for state, path in zip(states, paths):
        assert detector.path(state) == path
        assert path.split("/")[0] == detector.world.name
        assert len(path.split("/")) == detector.depth(state) + 1
        numbers = detector.daughter_numbers(state)
        assert detector.state_at(numbers).touchable == state["touchable"]
        named = []
        volume = detector.world
        for number in numbers:
            daughter = volume.daughters[number]
            named.append((daughter.name, daughter.copy_number))
            volume = daughter.volume
        assert volume.number == state["volume"]
        assert detector.path(detector.state_at(named)) == path
        if numbers:
            mother = detector.mother(state)
            assert detector.daughter_numbers(mother) == numbers[:-1]
            assert detector.copy_number(state) == named[-1][1]
    assert detector.state_at([]) == navjit.State(0, detector.world.number)


def test_frames_are_those_of_placements(detector):
    state, volume = detector.state_at([]), detector.world
    rotation, translation = np.eye(3), np.zeros(3)
    numbers = []
    while volume.daughters:
        deepest = [daughter.volume.touchables for daughter in volume.daughters]
        numbers.append(int(np.argmax(deepest)))
        daughter = volume.daughters[numbers[-1]]
        # local = R (outer - T)
        translation = translation + rotation.T @ daughter.translation
        rotation = daughter.rotation @ rotation
        volume = daughter.volume
        state = detector.state_at(numbers)
        made = detector.frame(state)
        np.testing.assert_allclose(made[0], rotation, atol=1e-12)
        np.testing.assert_allclose(made[1], translation, rtol=1e-12, atol=1e-9)
    assert detector.depth(state) == len(numbers) > 2


def test_written_and_read_again(detector, tmp_path):
    file = tmp_path / "again.gdml"
    file.write_text(detector.gdml())
    again = navjit.read_gdml(file)
    assert again.touchables == detector.touchables
    assert {v.name: v.touchables for v in again.volumes if v.touchables} == {
        v.name: v.touchables for v in detector.volumes if v.touchables
    }


def test_root_files():
    detector = navjit.read_root("tests/python/two_boxes.root")
    assert [d.name for d in detector.world.daughters] == ["leaf_1", "leaf_2"]
    assert detector.world.material.name == "Lead"
    with pytest.raises(navjit.ParseError, match="no geometry 'other'; choose one of 'boxes'"):
        navjit.read_root("tests/python/two_boxes.root", key="other")
    with pytest.raises(navjit.ParseError, match="no ROOT file"):
        navjit.read_root("detectors/absorber.gdml")


def test_paths_of_files_may_be_of_either_kind():
    for path in ("detectors/absorber.gdml", pathlib.Path("detectors/absorber.gdml")):
        assert navjit.read_gdml(path).touchables > 1
    with pytest.raises(TypeError):
        navjit.read_gdml(5)


def test_numbers_may_outlive_the_detector():
    material = navjit.read_gdml("detectors/shashlik.gdml").volumes[0].material
    assert material.name
    assert "'" + material.name + "'" in repr(material)
