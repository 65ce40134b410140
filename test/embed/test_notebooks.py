"""The notebooks of example/notebooks run from top to bottom, and are kept without their outputs."""

import os
import shutil
from unittest import mock

import nbformat
from nbclient import NotebookClient

from installed import ROOT, HostTest

NOTEBOOKS = sorted((ROOT / "example" / "notebooks").glob("*.ipynb"))
# Long enough for a machine ten times slower, s.
PATIENCE = 1200


class Notebooks(HostTest):
    def test_each_runs(self):
        """With the package and its library alone, as pip installs them: no program is there."""
        environment = self.installed.environment
        del environment["FASTSTRIP_PREFIX"]
        environment["FASTSTRIP_LIBRARY"] = str(self.installed.library)
        self.assertIsNone(shutil.which("faststrip", path=environment["PATH"]))
        shutil.copy(NOTEBOOKS[0].with_name("steel.fslt"), self.folder)
        environment["PYTHONPATH"] = str(ROOT / "python")
        environment["IPYTHONDIR"] = str(self.folder / "ipython")
        # Pictures in the notebook, whatever the tests draw with.
        environment["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
        with mock.patch.dict(os.environ, environment):
            for path in NOTEBOOKS:
                with self.subTest(path.name):
                    notebook = nbformat.read(path, as_version=4)
                    NotebookClient(notebook, timeout=PATIENCE, kernel_name="python3",
                                   resources={"metadata": {"path": str(self.folder)}}).execute()
                    outputs = [output for cell in notebook.cells if cell.cell_type == "code"
                               for output in cell.outputs]
                    self.assertTrue(any("image/png" in output.get("data", {})
                                        for output in outputs), "a picture")
                    said = [output.text for output in outputs if output.output_type == "stream"]
                    self.assertTrue(said)
                    self.assertNotIn("Warning", "".join(said))

    def test_three_are_kept_and_without_outputs(self):
        self.assertEqual([path.stem for path in NOTEBOOKS],
                         ["creep_curves", "lookup_table", "patch_and_pressure"])
        for path in NOTEBOOKS:
            notebook = nbformat.read(path, as_version=4)
            nbformat.validate(notebook)
            for cell in notebook.cells:
                with self.subTest(path.name, cell=cell.id):
                    if cell.cell_type == "code":
                        self.assertEqual((cell.outputs, cell.execution_count), ([], None))
                    self.assertEqual(cell.metadata, {})
                    for line in cell.source.splitlines():
                        self.assertLessEqual(len(line), 100)
