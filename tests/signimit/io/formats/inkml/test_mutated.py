"""Well-formed documents that say something else than was meant give strokes or sentences, never another error."""

import copy
from xml.etree.ElementTree import Element, fromstring

import numpy as np

from signimit import FileFormatError
from signimit.io.formats.inkml import parse_inkml
from signimit.io.formats.pen_recording import mend_recording

DOCUMENT = """<ink><definitions><timestamp id="s" time="5"/><timestamp id="t" timestampRef="#s" timeOffset="5"/>
<inkSource id="i"><traceFormat><channel name="X" units="mm"/><channel name="Y" orientation="-ve" units="in"/>
<intermittentChannels><channel name="T" units="ms" respectTo="#t"/><channel name="S" type="boolean" default="T"/>
</intermittentChannels></traceFormat><sampleRate value="50"/><channelProperties>
<channelProperty channel="X" name="resolution" value="100" units="1/mm"/></channelProperties></inkSource>
<canvas id="k"><traceFormat><channel name="X"/><channel name="Y"/></traceFormat></canvas>
<mapping id="m" type="affine"><affine>2 0 1, 0 2 1</affine></mapping></definitions>
<context id="c" inkSourceRef="#i" canvasRef="#k" timestampRef="#s"><canvasTransform><mapping mappingRef="#m"/>
</canvasTransform></context><trace id="0" timeOffset="3" duration="40">1 2 0 T, 3 4 20, * * * F, ? 4 #f, '5 7 60,
</trace><traceGroup id="g"><annotation type="label">w</annotation><trace id="1" type="indeterminate" contextRef="#c"
continuation="end" priorRef="#0">5 5 100 T,6 7 120 T,7 9 140 F</trace><traceGroup><trace>1 1, 2 2</trace></traceGroup>
</traceGroup><traceView><traceView traceDataRef="#0" from="1" to="3"/><traceView id="v" traceDataRef="#g" to="2:1:1"/>
</traceView></ink>"""
TOKENS = ("#0", "#1", "#g", "#v", "#c", "#s", "#t", "#m", "#i", "1", "0", "-1", "2:1", "1:1:1", "1e308", "-1e-320",
          "nan", "inf", "T", "F", "*", "?", "'", '"', "!", ",", ",,", "penUp", "indeterminate", "middle", "X", "Y", "s",
          "ms", "1/s", "dev", "m", "em", "-ve", "affine", "product", "mathml", "resolution")  # fmt: skip


def mutate(root: Element, rng: np.random.Generator) -> None:
    """Change an attribute, a text, a name, or which elements there are and where."""
    elements = list(root.iter())
    element, other = (elements[i] for i in rng.integers(len(elements), size=2))
    token, kind = TOKENS[rng.integers(len(TOKENS))], rng.integers(6)
    if kind <= 1 and element.attrib:
        element.set(list(element.attrib)[rng.integers(len(element.attrib))], token)
    elif kind == 2:
        text = element.text or ""
        i = int(rng.integers(len(text) + 1))
        element.text = text[:i] + token + text[i + int(rng.integers(6)) :]
    elif kind == 3 and len(element):
        element.remove(element[rng.integers(len(element))])
    elif kind == 4 and len(elements) < 200:
        other.append(copy.deepcopy(element))
    elif element is not root and other is not root:
        element.tag = other.tag


def test_mutated_documents_give_strokes_or_sentences() -> None:
    rng, whole = np.random.default_rng(0), fromstring(DOCUMENT)
    strokes, errors = 0, []
    for _ in range(600):
        root = copy.deepcopy(whole)
        for _ in range(rng.integers(1, 6)):
            mutate(root, rng)
        try:
            file = parse_inkml(root, "house.inkml")
        except FileFormatError as error:
            errors.append(error)
            continue
        errors += file.left_out
        for recording in file.recordings:
            try:
                strokes += len(mend_recording(recording).stroke) > 1
            except FileFormatError as error:
                errors.append(error)
    assert strokes > 200
    assert len(errors) > 200
    assert [e for e in map(str, errors) if not e.startswith("house.inkml: ") or "\n" in e] == []
