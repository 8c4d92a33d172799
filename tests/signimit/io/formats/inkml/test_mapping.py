"""Mappings onto the canvas."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_allclose, assert_array_equal

from signimit import FileFormatError, StrokeLibrary

Read = Callable[..., StrokeLibrary]
TRACE = "<trace>1 2, 3 4, 5 7</trace>"
BIND_X = '<bind source="X" target="X"/>'


def canvas(mapping: str, canvas: str = "", trace: str = TRACE) -> str:
    return f'<context xml:id="c">{canvas}<canvasTransform xml:id="t">{mapping}</canvasTransform></context>{trace}'


def affine(matrix: str, binds: str = "") -> str:
    return f'<mapping type="affine">{binds}<affine>{matrix}</affine></mapping>'


@pytest.mark.parametrize(
    ("mapping", "points"),
    [
        ('<mapping type="identity"/>', [(1, -2), (3, -4), (5, -7)]),
        ('<mapping type="unknown"/>', [(1, -2), (3, -4), (5, -7)]),
        ("<mapping/>", [(1, -2), (3, -4), (5, -7)]),
        (affine("2 0 10, 0 3 20"), [(12, -26), (16, -32), (20, -41)]),
        (affine("2 0, 0 3"), [(2, -6), (6, -12), (10, -21)]),
        (affine("0 1 0,-1 0 0"), [(2, 1), (4, 3), (7, 5)]),  # a quarter turn
        (affine("1 0 0, 0 1 0").replace(' type="affine"', ""), [(1, -2), (3, -4), (5, -7)]),
        (affine("1 0 5", '<bind target="X"/><bind source="X"/><bind source="Y"/>'), [(6, -2), (8, -4), (10, -7)]),
        (affine("1 5", '<bind source="Y" target="X"/>'), [(7, -2), (9, -4), (12, -7)]),
        (
            f"<mapping type='product'>{affine('2 0', BIND_X)}{affine('3 1', BIND_X.replace('X', 'Y'))}</mapping>",
            [(2, -7), (6, -13), (10, -22)],
        ),
        (affine("0 1, 1 0") + affine("9 9, 9 9"), [(2, -1), (4, -3), (7, -5)]),  # the second leads back
        (
            '<mapping type="table"><bind target="F" column="1"/><table>1 2</table></mapping>',
            [(1, -2), (3, -4), (5, -7)],
        ),
    ],
)
def test_points_on_the_canvas(read: Read, mapping: str, points: list[tuple[float, float]]) -> None:
    assert_allclose(read(canvas(mapping))[0].points, points)


def test_a_mapping_may_be_referred_to(read: Read) -> None:
    body = (
        f'<definitions><mapping xml:id="m" {affine("2 0, 0 2")[9:]}'
        '<canvasTransform xml:id="t"><mapping mappingRef="#m"/></canvasTransform></definitions>'
        f'<context canvasTransformRef="#t"/>{TRACE}'
    )
    assert_array_equal(read(body)[0].points, [(2, -4), (6, -8), (10, -14)])


def test_the_canvas_says_which_way_its_channels_grow_and_the_device_no_more(read: Read) -> None:
    left, right = (
        '<traceFormat><channel name="X"{}/><channel name="Y"{}/></traceFormat>'.format(*signs)
        for signs in (("", ' orientation="-ve"'), (' orientation="-ve"', ""))
    )
    device, plane = f'<inkSource xml:id="i">{left}</inkSource>', f'<canvas xml:id="p">{right}</canvas>'
    library = read(canvas(affine("1 0 0, 0 -1 0"), device + plane))
    assert_array_equal(library[0].points, [(-1, 2), (-3, 4), (-5, 7)])


def test_the_clock_goes_through_unmapped(read: Read) -> None:
    layout = '<traceFormat><channel name="X"/><channel name="Y"/><channel name="T" units="s"/></traceFormat>'
    library = read(canvas(affine("2 0, 0 2"), layout, "<trace>0 0 0, 1 1 0.5, 2 3 1</trace>"))
    assert_allclose(library[0].times, [0, 0.5, 1])
    assert_array_equal(library[0].points, [(0, 0), (2, -2), (4, -6)])


@pytest.mark.parametrize(
    ("mapping", "match"),
    [
        ('<mapping type="mathml"><bind target="X" variable="x"/></mapping>', "affine or product, found 'mathml'"),
        ('<mapping type="table"><bind target="Y" column="1"/><table>1 2</table></mapping>', "found 'table'"),
        ('<mapping type="table"><table>1 2</table></mapping>', "found 'table'"),
        ('<mapping type="affine"/>', "found 'affine'"),
        (affine("1 0, 0"), "canvasTransform: affine: expected a matrix with a row for each target"),
        (affine("1 0, 0 x"), "canvasTransform: affine: expected a matrix"),
        (affine("1 0 0 0, 0 1 0 0"), "canvasTransform: affine: expected a matrix"),
        (affine("1, 0"), "canvasTransform: affine: expected a matrix"),
        (affine(""), "canvasTransform: affine: expected a matrix"),
        (affine("1e300 0, 0 1"), "canvasTransform: affine: expected a matrix"),
        (affine("nan 0, 0 1"), "canvasTransform: affine: expected a matrix"),
        (affine("1 0", '<bind source="OTx" target="X"/>'), "canvasTransform: expected channels X, Y, found OTx"),
        ('<mapping mappingRef="#no"/>', "canvasTransform: expected a mapping of this file, found '#no'"),
    ],
)
def test_mappings_that_are_not_understood_are_refused_by_name(read: Read, mapping: str, match: str) -> None:
    with pytest.raises(FileFormatError, match=match):
        read(canvas(mapping))


def test_mappings_that_multiply_are_refused(read: Read) -> None:
    twice = '<mapping mappingRef="#m"/>' * 2
    body = f'<definitions><mapping xml:id="m" type="product">{twice}</mapping></definitions>'
    with pytest.raises(FileFormatError, match="canvasTransform: expected at most 100 mappings, found more"):
        read(body + canvas('<mapping mappingRef="#m"/>'))
