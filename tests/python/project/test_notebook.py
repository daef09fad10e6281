"""The notebook of the examples: its cells run, and show what the file holds. Run as a script it writes them anew."""

import ast
import base64
import io
import json
from pathlib import Path

NOTEBOOK = Path(__file__).parents[3] / "examples/notebook/first_machine.ipynb"


def shown(code, names):
    """Run the code of a cell; return its last expression as a notebook shows it."""
    *before, last = ast.parse(code).body
    exec(compile(ast.Module(before, []), NOTEBOOK.name, "exec"), names)
    value = eval(compile(ast.Expression(last.value), NOTEBOOK.name, "eval"), names)
    data = {"text/plain": [repr(value)]}
    if hasattr(value, "_repr_html_"):
        data["text/html"] = [value._repr_html_()]
    if hasattr(value, "savefig"):
        picture = io.BytesIO()
        value.savefig(picture, format="png", dpi=60)
        data["image/png"] = base64.b64encode(picture.getvalue()).decode()
    return data


def cells():
    return [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]


def test_the_notebook_shows_what_its_cells_return():
    names, kinds = {}, set()
    for cell in cells():
        data, (output,) = shown("".join(cell["source"]), names), cell["outputs"]
        assert data.keys() == output["data"].keys()
        assert data["text/plain"] == output["data"]["text/plain"]
        kinds |= data.keys()
    assert kinds == {"text/plain", "text/html", "image/png"}


if __name__ == "__main__":
    notebook, names = json.loads(NOTEBOOK.read_text()), {}
    for count, cell in enumerate((one for one in notebook["cells"] if one["cell_type"] == "code"), 1):
        output = {"data": shown("".join(cell["source"]), names), "execution_count": count, "metadata": {}}
        cell |= {"execution_count": count, "outputs": [output | {"output_type": "execute_result"}]}
    NOTEBOOK.write_text(json.dumps(notebook, indent=1) + "\n")
