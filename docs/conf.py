"""Sphinx settings of the documentation: `sphinx-build -W --keep-going -b html docs build/docs`.

The pages are the Markdown files of this folder, written to be read without Sphinx too. The reference, the gallery and
the pages about the project are made from the sources when the site is built; the modules are in `builder`.
Nothing is loaded from a network, neither by the build nor by the finished pages: formulas are text, without a script.
"""

import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS))

import builder  # noqa: E402
from builder import docstrings, formulas  # noqa: E402

import ninedof  # noqa: E402

project = "ninedof"
author = copyright = "The ninedof authors"
version = release = ninedof.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["builder"]
highlight_language = "none"  # an indented block is a formula
smartquotes = False  # J' is no quotation

myst_heading_anchors = 4  # links to headings as a repository page has them

autodoc_default_options = {"members": True, "undoc-members": True}
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints = "none"  # types are in the tables of parameters, in words
autodoc_class_signature = "mixed"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_preprocess_types = False
default_role = "py:obj"  # `name` in a docstring is a link where the name is public
add_module_names = False
python_maximum_signature_line_length = 90

html_theme = "furo"
html_title = f"ninedof {version}"
html_static_path = ["builder/static"]
html_css_files = ["pages.css"]
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f5a96", "color-brand-content": "#1f5a96"},
    "dark_css_variables": {"color-brand-primary": "#7fb3e6", "color-brand-content": "#7fb3e6"},
}


def setup(app):
    """Make the pages that come from the sources; complete each page as it is read."""
    app.connect("autodoc-process-docstring", docstrings.read, priority=400)
    app.connect("doctree-read", docstrings.whole_names)
    app.connect("missing-reference", docstrings.public_name)
    app.connect("doctree-read", formulas.lower_indices)
    app.connect("builder-inited", lambda app: builder.generate(DOCS))
    app.connect("source-read", lambda app, page, source: builder.complete(DOCS, page, source))
