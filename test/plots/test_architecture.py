"""The picture of the architecture: its steps are those of the page, their modules are there."""

import unittest

import matplotlib.image

from plot_samples import Folder, load


class Architecture(unittest.TestCase):
    def setUp(self):
        self.picture = load("architecture")

    def test_twelve_steps_of_modules_that_exist(self):
        way = self.picture.steps()
        self.assertEqual([number for number, _, _ in way], list(range(1, 13)))
        for number, words, modules in way:
            self.assertTrue(words and modules, number)
            for module in modules:
                room = self.picture.room_of(module)
                folder = self.picture.FOLDERS.get(room, self.picture.CORE / room)
                place = folder.joinpath(*module.split("/")[1:])
                self.assertTrue(place.is_dir() or place.with_suffix(".f90").exists(), module)

    def test_a_module_of_no_room_is_none(self):
        self.assertEqual(self.picture.steps("| 1 | words | `contact/solve` |\n"),
                         [(1, "words", ["contact/solve"])])
        with self.assertRaises(StopIteration):
            self.picture.room_of("nowhere/solve")

    def test_every_room_has_lines(self):
        for room in self.picture.ROOMS:
            self.assertGreater(len(self.picture.sources(room)), 3, room)
            self.assertGreater(self.picture.lines(room), 100, room)

    def test_drawn(self):
        with Folder({}) as folder:
            status, out, err = folder.run("architecture", "-o", "a.png")
            self.assertEqual((status, out, err), (0, "a.png\n", ""))
            pixels = matplotlib.image.imread(folder.path / "a.png")
        self.assertGreater(min(pixels.shape[:2]), 300)
        self.assertGreater(pixels.std(), 0.05, "nothing is drawn")
