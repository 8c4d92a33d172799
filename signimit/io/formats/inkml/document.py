"""An InkML document: its elements by id, and what they are annotated with."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from xml.etree.ElementTree import Element

from signimit.exceptions import FileFormatError
from signimit.io.formats.xmlfile import local_name

_XML = "{http://www.w3.org/XML/1998/namespace}"
_LABEL_TYPES = ("label", "truth", "transcription")
_LONGEST_CHAIN = 100  # references that lead to references


class InkDocument:
    """The elements of a document, found by the references to them.

    Attributes:
        root: The ``<ink>`` element.
        where: The file, for errors.
    """

    def __init__(self, root: Element, where: str) -> None:
        """Find the elements that have an id.

        Raises:
            FileFormatError: If the root is not an ink element.
        """
        if local_name(root) != "ink":
            raise FileFormatError(where, "an ink element", f"{local_name(root)!r}")
        self.root, self.where = root, where
        self._named: dict[tuple[str, str], list[Element]] = defaultdict(list)
        self._kinds: dict[str, list[Element]] = defaultdict(list)
        ours = {"", root.tag.rpartition("}")[0]}  # others' context is another thing, e.g. msink:context
        for element in root.iter():
            if not isinstance(element.tag, str) or element.tag.rpartition("}")[0] not in ours:
                continue
            kind, name = local_name(element), identity(element)
            self._kinds[kind].append(element)
            if name:
                self._named[kind, name].append(element)

    def elements(self, kind: str) -> Sequence[Element]:
        """Return the elements of a kind, in the order of the file."""
        return self._kinds.get(kind, ())

    def find(self, reference: str, kinds: Sequence[str], what: str) -> Element:
        """Return the element that is referred to, e.g. by ``"#t1"``; the kinds are searched in their order.

        Raises:
            FileFormatError: If there is none in this file, or several.
        """
        outside, _, name = reference.strip().rpartition("#")
        for kind in kinds:
            found = [] if outside else self._named.get((kind, name), [])
            if len(found) > 1:
                raise FileFormatError(what, f"one {kind} with the id {name!r}", f"{len(found)}")
            if found:
                return found[0]
        raise FileFormatError(what, f"a {' or '.join(kinds)} of this file", repr(reference.strip()[:60]))

    def chain(self, element: Element, attribute: str, kind: str) -> list[Element]:
        """Return an element and those that it builds on by references, the most basic one first.

        Raises:
            FileFormatError: If a reference leads nowhere or in a circle.
        """
        found = [element]
        while reference := found[-1].get(attribute):
            if reference.lstrip("#").startswith("Default"):  # the standard's own, e.g. #DefaultContext
                break
            found.append(self.find(reference, (kind,), attribute))
            if len(found) > _LONGEST_CHAIN:
                raise FileFormatError(attribute, f"a {kind} that does not refer to itself", repr(reference[:60]))
        return found[::-1]


def identity(element: Element) -> str | None:
    """Return the id of an element."""
    return (element.get(f"{_XML}id") or element.get("id") or element.get(f"{_XML}ID") or "").strip() or None


def read_label(element: Element) -> str | None:
    """Return what an element is labelled with.

    That is its first annotation of type label, truth or transcription, else the first literal of its EMMA
    interpretations (``<annotationXML>``), which is the recogniser's best guess.
    """
    label = read_annotation(element, _LABEL_TYPES)
    for child in element if label is None else ():
        if local_name(child) == "annotationXML":
            literals = (e.text.strip() for e in child.iter() if local_name(e) == "literal" and e.text)
            label = next(filter(None, literals), None)
            if label is not None:
                break
    return label


def read_annotation(element: Element, types: Sequence[str]) -> str | None:
    """Return the text of an element's first annotation of one of these types."""
    for child in element:
        if local_name(child) == "annotation" and child.get("type", "").lower() in types and child.text:
            text = child.text.strip()
            if text:
                return text
    return None
