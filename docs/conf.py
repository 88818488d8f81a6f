"""The site: MyST pages, the names of the package, and the examples, run as the site is built. Needs no network."""

import sys
import warnings
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "pointchart"
author = "The pointchart maintainers"
copyright = f"2026, {author}"
release = version = version_of("pointchart")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "listings",
]
exclude_patterns = ["_ext", "Thumbs.db"]
default_role = "py:obj"
nitpicky = False

myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
copybutton_prompt_text = "$ "
copybutton_exclude = ".linenos, .gp, .go"

autosummary_generate = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False

# The examples make figures that nobody looks at while they run.
warnings.filterwarnings("ignore", message="FigureCanvasAgg is non-interactive")
sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "examples",
    "filename_pattern": r"\.py$",
    "backreferences_dir": None,
    "download_all_examples": False,
    "image_srcset": ["2x"],
    "write_computation_times": False,
    "reset_modules": ("matplotlib", "palette.on_paper"),
    "within_subsection_order": "ExampleTitleSortKey",
    "min_reported_time": 1e9,
    "show_memory": False,
    "show_signature": False,
    "abort_on_example_error": True,
}

html_theme = "furo"
pygments_style = "friendly"
pygments_dark_style = "github-dark"
html_title = "pointchart"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {
        "color-background-primary": "#fbfaf7",
        "color-background-secondary": "#f3f1ec",
        "color-background-border": "#ccd6d8",
        "color-foreground-primary": "#22303c",
        "color-foreground-secondary": "#4c5a66",
        "color-brand-primary": "#a8402b",
        "color-brand-content": "#a8402b",
        "color-brand-visited": "#8a4a3c",
        "color-api-name": "#a8402b",
        "color-api-pre-name": "#4c5a66",
        "color-code-background": "#f3f1ec",
    },
    "dark_css_variables": {
        "color-background-primary": "#17212a",
        "color-background-secondary": "#1d2933",
        "color-background-border": "#34434f",
        "color-foreground-primary": "#e6e9e8",
        "color-foreground-secondary": "#b3c0c3",
        "color-brand-primary": "#ec8a72",
        "color-brand-content": "#ec8a72",
        "color-brand-visited": "#d99a8b",
        "color-api-name": "#ec8a72",
        "color-api-pre-name": "#b3c0c3",
        "color-code-background": "#1d2933",
    },
}
