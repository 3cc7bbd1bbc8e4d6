"""Builds HTML by nested calls. Texts are escaped unless they are Html."""
import html
import json


class Html(str):
    """HTML text, not to be escaped."""


def escaped(value):
    return value if isinstance(value, Html) else Html(html.escape(str(value), quote=True))


def joined(parts, between=""):
    return Html(between.join(escaped(part) for part in parts if part is not None))


def _attribute(key, value):
    key = key.rstrip("_").replace("_", "-")
    return f" {key}" if value is True else f' {key}="{html.escape(str(value), quote=True)}"'


def tag(name, /, *children, **attributes):
    """An HTML element: tag("td", "1 < 2", class_="num"). Attributes that are None or False are left out."""
    given = "".join(_attribute(k, v) for k, v in attributes.items() if v is not None and v is not False)
    return Html(f"<{name}{given}>{joined(children)}</{name}>")


def void(name, /, **attributes):
    return Html(f"<{name}{''.join(_attribute(k, v) for k, v in attributes.items() if v not in (None, False))}>")


def data_script(identity, value):
    """A script element with JSON for the page's script. '<' is escaped, so that texts cannot close the element."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    text = text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
    return Html(f'<script type="application/json" id="{identity}">{text}</script>')


def scrolling(*children, label):
    """A box that can be scrolled, also by keyboard."""
    return tag("div", *children, class_="scroll", tabindex="0", role="region", aria_label=label)
