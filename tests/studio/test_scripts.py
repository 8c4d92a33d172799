"""The page's scripts, function by function: one page imports the modules, and each test calls what it is about."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from signimit_envs.studio.arm.camera import picture_mapping
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.prompts import LANGUAGES, prompt_text
from signimit_envs.studio.page.views import language_json
from signimit_envs.studio.web.messages import NewDraft, StrokeMessage

Json = dict[str, Any]
Call = Callable[..., Any]
FACTS = {
    "picture": picture_mapping(),
    "table": [0.55, 0.45],
    "objects": ["red", "green", "blue", "yellow", "black", "white"],
    "colours": ["#e84036", "#42a054", "#3876dc"],
    "can_draw": False,
}
LINE: Json = {"points": [[0, 0], [1, 2], [3, 4]], "times": [0, 0.1, 0.2]}


@pytest.fixture(scope="module")
def page(browser: Any, address: str) -> Iterator[Any]:
    """The studio's page without the script that starts it."""
    context = browser.new_context(reduced_motion="reduce")
    opened = context.new_page()
    opened.route("**/studio.js", lambda route: route.fulfill(body="", content_type="text/javascript"))
    opened.goto(address)
    yield opened
    context.close()


@pytest.fixture
def call(page: Any) -> Call:
    """Calls a function of JavaScript with a module of the page and arguments; a session is open in none of them."""
    begin = "async (facts) => { Object.assign((await import('./store.js')).store, { studio: facts, session: null }) }"
    page.evaluate(begin, FACTS)

    def evaluate(module: str, function: str, *arguments: Any) -> Any:
        script = f"async (given) => ({function})(await import('./{module}.js'), ...given)"
        return page.evaluate(script, list(arguments))

    return evaluate


RECORD = """
({ Recording }, spent, samples) => {
  const made = new Recording(spent);
  for (const [x, y, time] of samples) made.add([x, y], time);
  return { ...made.stroke, reach: made.reach, late: made.late };
}
"""


def test_a_recording_begins_at_time_0_and_its_clock_never_goes_back(call: Call) -> None:
    made = call("pen", RECORD, 0, [[0, 0, 5.0], [3, 4, 5.5], [1, 1, 5.25]])
    assert made == {"points": [[0, 0], [3, 4], [1, 1]], "times": [0, 0.5, 0.5], "reach": 5, "late": False}


@pytest.mark.parametrize("spent", [0, 500])
def test_what_comes_after_the_longest_time_of_a_drawing_is_left_out_and_said(spent: float, call: Call) -> None:
    made = call("pen", RECORD, spent, [[0, 0, 0], [1, 0, 70], [2, 0, 581 - spent]])
    assert made["points"] == [[0, 0], [1, 0]]
    assert made["late"]
    assert spent + made["times"][-1] <= LIMITS.seconds


THIN = """
({ fewEnough }, counts) => {
  const samples = (count) => Array.from({ length: count }, (_, i) => i);
  const strokes = counts.map((count) => ({ points: samples(count).map((i) => [i, 0]), times: samples(count) }));
  const thinned = fewEnough(strokes);
  const together = thinned.every(({ points, times }) => points.every(([x], i) => x === times[i]));
  return [together, thinned.map(({ times }) => times)];
}
"""


@pytest.mark.parametrize("counts", [[4000], [4001], [9999, 3], [1, 2, 8000], [3000, 3000, 3000]])
def test_strokes_are_thinned_to_few_enough_and_keep_their_ends(counts: list[int], call: Call) -> None:
    together, kept = call("pen", THIN, counts)
    assert together
    assert 1500 < sum(map(len, kept)) <= 4000 < LIMITS.points
    for times, count in zip(kept, counts, strict=True):
        assert (times[0], times[-1]) == (0, count - 1)
        assert (np.diff(times) > 0).all()


@pytest.mark.parametrize("gap", [0.0, 0.5, 2.0])
def test_two_strokes_are_joined_by_a_straight_bridge_that_the_server_takes(gap: float, call: Call) -> None:
    second = {"points": [[3 + gap, 4], [5, 5]], "times": [0, 0.3]}
    both = call("pen", "({ joined }, first, second) => joined(first, second)", LINE, second)
    points, times = np.array(both["points"]), np.array(both["times"])
    bridge = slice(2, len(points) - 1)
    assert (points[:3] == LINE["points"]).all()
    assert (points[-2:] == second["points"]).all()
    np.testing.assert_allclose(points[bridge, 1], 4)
    np.testing.assert_allclose(points[bridge, 0], np.linspace(3, 3 + gap, len(points[bridge])))
    assert (np.diff(times) > 0).all()
    assert 0.04 - 1e-9 <= times[-2] - times[2] <= 0.3 + 1e-9
    StrokeMessage(**both).stroke("sign")


def test_samples_have_passed_when_their_time_has_come(call: Call) -> None:
    times, counted = [0, 1, 1, 2], "({ passed }, times, now, count) => passed(times, now, count)"
    assert [call("pen", counted, times, now, 0) for now in (-1, 0, 1, 1.5, 9)] == [0, 1, 3, 3, 4]
    assert call("pen", counted, times, 0, 2) == 2


@pytest.mark.parametrize("points", [[[10, 20], [14, 22]], [[0, 0], [0, 5], [1, 1]], [[7, 7], [7, 7]]])
def test_a_stroke_fits_into_the_middle_of_a_pad_in_its_own_shape(points: list[list[float]], call: Call) -> None:
    fitted = call("pad", "({ fitted }, stroke) => fitted(stroke)", {"points": points, "times": [0, 1, 2]})
    made, drawn = np.array(fitted["points"]), np.array(points)
    np.testing.assert_allclose(made.max(axis=0) + made.min(axis=0), 0, atol=1e-12)
    size = np.ptp(drawn, axis=0).max()
    np.testing.assert_allclose(np.ptp(made, axis=0) * size, 1.6 * np.ptp(drawn, axis=0), atol=1e-12)
    assert fitted["times"] == [0, 1, 2]


DRAW = """
({ SignPad }, strokes) => {
  const pad = new SignPad(1, () => {});
  pad.canvas.getBoundingClientRect = () => ({ width: 100 });
  pad.paint = () => {}; // for speed
  const heard = performance.now;
  let now = 0;
  performance.now = () => now;
  for (const { pause, points } of strokes) {
    now += 1000 * pause;
    points.forEach(([x, y], i) => pad[i ? "move" : "begin"]({ x, y, time: i / 10 }));
    pad.end();
  }
  performance.now = heard;
  return [pad.parts.length, pad.stroke];
}
"""
STROKE: Json = {"pause": 0, "points": [[20, 20], [60, 20], [60, 60]]}


DRAW_MUCH = """
({ SignPad }) => {
  const pad = new SignPad(1, () => {});
  pad.canvas.getBoundingClientRect = () => ({ width: 100 });
  pad.paint = () => {}; // for speed
  for (let stroke = 0; stroke < 3; stroke += 1) {
    pad.begin({ x: 0, y: 0, time: 0 });
    for (let i = 1; i < 6000; i += 1) pad.move({ x: i % 100, y: stroke, time: i / 1000 });
    pad.end();
  }
  return [pad.parts.length, pad.stroke.points.length, pad.stroke.times];
}
"""


def test_strokes_of_a_fast_mouse_are_thinned_until_the_server_takes_them(call: Call) -> None:
    strokes, points, times = call("pad", DRAW_MUCH)
    assert strokes == 3
    assert 1000 < points == len(times) <= LIMITS.points
    assert times[-1] == pytest.approx(3 * 5.999, abs=1)


@pytest.mark.parametrize(("pause", "parts"), [(1.4, 2), (1.6, 1)])
def test_a_stroke_goes_on_with_the_sign_unless_there_was_a_pause(pause: float, parts: int, call: Call) -> None:
    assert call("pad", DRAW, [{**STROKE, "pause": 9}, {**STROKE, "pause": pause}])[0] == parts


def test_a_tap_is_no_stroke(call: Call) -> None:
    assert call("pad", DRAW, [{**STROKE, "points": [[20, 20], [21, 21]]}]) == [0, None]


PLAY = """
async ({ playing }, times, speed, last) => {
  const counts = [];
  await playing(times, (count) => counts.push(count) < last, speed);
  return counts;
}
"""


def test_strokes_are_played_in_time_to_the_end_or_until_told_to_stop(page: Any, call: Call) -> None:
    assert call("pad", PLAY, [0, 0.01, 0.02], 2, 1e9) == [3]  # for those who want no motion
    page.emulate_media(reduced_motion="no-preference")
    counts = call("pad", PLAY, [0, 0.05, 0.1], 2, 1e9)
    assert counts == sorted(counts)
    assert counts[-1] == 3
    assert len(call("pad", PLAY, [0, 0.05, 60.0], 2, 2)) == 2
    page.emulate_media(reduced_motion="reduce")


@pytest.mark.parametrize("plane", ["table", "hand"])
def test_pixels_and_metres_are_mapped_as_the_camera_says(plane: str, call: Call, in_picture: Any) -> None:
    places = np.array([[0, 0], [-0.4, 0.3], [0.25, -0.2]])
    pixels = call("stage", "({ toPixels }, all, plane) => all.map((x) => toPixels(x, plane))", places.tolist(), plane)
    np.testing.assert_allclose(pixels, in_picture(FACTS["picture"], places, plane) * [640, 480])
    back = call("stage", "({ toMetres }, all, plane) => all.map((x) => toMetres(x, plane))", pixels, plane)
    np.testing.assert_allclose(back, places, atol=1e-12)


def test_a_pen_beside_the_sheet_is_on_its_edge(call: Call) -> None:
    script = """({ Stage }, all) => {
      const sheet = { getBoundingClientRect: () => ({ width: 64, height: 48 }) };
      return all.map(([x, y]) => Stage.prototype.within.call({ sheet }, { x, y }));
    }"""
    places = call("stage", script, [[-5, 50], [70, 20], [3, -4]])
    assert [(place["x"], place["y"]) for place in places] == [(0, 48), (64, 20), (3, 0)]


def _session(drawn: Json | None = None, number: int | None = None, count: int = 2, revision: int = 3) -> Json:
    return {
        "id": "one",
        "events": revision,
        "revision": revision,
        "next": {"scene": {"objects": [], "hand": [0, count]}},
        "demonstrations": [{}] * count,
        "draft": {"number": number, "drawn": drawn or {}},
    }


FOLLOW = """
({ Draft }, unsent, ...sessions) => {
  const draft = new Draft("one");
  const places = sessions.map((session) => {
    const found = draft.follow(session);
    Object.assign(draft.drawn, unsent);
    Object.assign(draft.unsent, unsent);
    return found;
  });
  return { places, drawn: draft.drawn, number: draft.number };
}
"""


def test_a_draft_follows_what_other_pages_draw(call: Call) -> None:
    sessions = _session(), _session({"sign 1": [LINE]}), _session({"sign 1": [LINE], "hand": [LINE]})
    made = call("draft", FOLLOW, {}, *sessions)
    assert made["places"] == [None, ["sign 1"], ["hand"]]
    assert made["drawn"] == {"sign 1": [LINE], "hand": [LINE]}


def test_what_is_drawn_here_and_not_sent_yet_is_not_written_over(call: Call) -> None:
    own = {"sign 1": [{**LINE, "times": [0, 1, 2]}]}
    made = call("draft", FOLLOW, own, _session(), _session({"sign 1": [LINE], "sign 2": [LINE]}))
    assert made["places"] == [None, ["sign 2"]]
    assert made["drawn"] == {**own, "sign 2": [LINE]}


def test_a_draft_begins_anew_with_another_table_and_another_demonstration(call: Call) -> None:
    drawn = {"sign 1": [LINE]}
    taught = call("draft", FOLLOW, {}, _session(drawn), _session({"question": [LINE]}, count=3))
    assert (taught["places"], taught["drawn"]) == ([None, None], {"question": [LINE]})
    turned = call("draft", FOLLOW, {}, _session(drawn), _session({"hand": [LINE]}, number=1))
    assert (turned["places"], turned["drawn"], turned["number"]) == ([None, None], {"hand": [LINE]}, 1)


SEND = """
async ({ Draft }, session, answers, deeds) => {
  const { store } = await import("./store.js");
  store.session = session;
  const draft = new Draft("one");
  draft.follow(session);
  const sent = [];
  const fetched = window.fetch;
  window.fetch = async (path, { body } = {}) => {
    sent.push(body ? JSON.parse(body) : path);
    const [status, told] = answers.shift();
    if (told.revision !== undefined) draft.follow(told); // as the page does when the session changes
    return new Response(JSON.stringify(told), { status });
  };
  for (const drawn of deeds) draft.keep(drawn);
  await draft.sent;
  window.fetch = fetched;
  const alert = document.getElementById("alert");
  const said = alert.hidden ? "" : alert.textContent;
  alert.hidden = true;
  return { sent, unsent: draft.unsent, said };
}
"""


def test_strokes_are_sent_one_after_the_other_as_the_server_takes_them(call: Call) -> None:
    session, deeds = _session(), [{"sign 1": [LINE]}, {"sign 2": [LINE]}, {"hand": []}]
    answers = [[200, _session(revision=3)], [200, _session(revision=3)]]
    made = call("draft", SEND, session, answers, deeds)
    assert [sent["drawn"] for sent in made["sent"]] == [{"sign 1": [LINE], "sign 2": [LINE], "hand": []}]
    assert (made["unsent"], made["said"]) == ({}, "")
    for sent in made["sent"]:
        NewDraft(**sent).event()


def test_a_stroke_for_an_older_revision_of_the_same_table_is_sent_again(call: Call) -> None:
    answers = [[409, {"error": "stale"}], [200, _session(revision=4)], [200, _session(revision=4)]]
    made = call("draft", SEND, _session(), answers, [{"sign 1": [LINE]}])
    first, asked, again = made["sent"]
    assert (first["revision"], again["revision"]) == (3, 4)
    assert first["drawn"] == again["drawn"] == {"sign 1": [LINE]}
    assert asked == "api/sessions/one"
    assert (made["unsent"], made["said"]) == ({}, "")


@pytest.mark.parametrize(("status", "unsent"), [(422, {}), (507, {"sign 1": [LINE]})])
def test_a_stroke_that_is_refused_is_said_and_kept_unless_it_is_unusable(status: int, unsent: Json, call: Call) -> None:
    made = call("draft", SEND, _session(), [[status, {"error": "no such stroke"}]], [{"sign 1": [LINE]}])
    assert made["unsent"] == unsent
    assert "no such stroke" in made["said"]


def test_objects_of_a_replay_are_where_they_were_at_that_time(call: Call) -> None:
    moves = [[0.0, "a"], [1.0, "b"], [2.5, "c"]]
    script = "({ objectsAt }, moves, times) => times.map((time) => objectsAt(moves, time))"
    assert call("replay", script, moves, [-1, 0, 0.99, 1, 2.6]) == ["a", "a", "a", "b", "c"]


def test_shades_go_from_dark_to_bright_and_stay_within(call: Call) -> None:
    shades = call("matrix", "({ shade }, shares) => shares.map(shade)", [-1, 0, 0.2, 1, 2])
    assert shades[0] == shades[1] == "rgb(0 32 77)"
    assert shades[2] == "rgb(49 68 107)"
    assert shades[3] == shades[4] == "rgb(255 234 70)"


MATRIX = """
({ Matrix }, data, view, cell) => {
  const matrix = Object.assign(Object.create(Matrix.prototype), { data, frames: { value: view } });
  return [matrix.range, matrix.describe(cell)];
}
"""
DATA = {
    "order": [1, 0],
    "labels": [0, 1],
    "maximum": [[9.0, 1.0], [np.e, 0.0]],
    "frames": [[[[0, 0.0], [0.5, 0]], [[0, 2], [2, 0]]]],
}


def test_the_matrix_says_which_demonstrations_are_compared_and_how_alike_they_are(call: Call) -> None:
    extent, told = call("matrix", MATRIX, DATA, "maximum", [0, 1])
    assert extent == [0, 1]  # logarithms, the diagonal left out
    assert told == "Demonstrations 2 and 1, movements 2 and 1: 2.72 / rad²"
    assert call("matrix", MATRIX, DATA, "0 1", [1, 0])[1].endswith(": 2.00 / rad²")
    assert call("matrix", MATRIX, DATA, "0 0", [1, 1])[1] == "Demonstration 1 with itself."
    assert call("matrix", MATRIX, {**DATA, "labels": [1, 1]}, "maximum", [0, 1])[1].count("both movement 2") == 1
    told = [call("matrix", MATRIX, {**DATA, "labels": labels}, "maximum", [0, 1])[1] for labels in ([0, -1], [-1, -1])]
    assert ["movements none and 1:" in told[0], "1, no movement:" in told[1]] == [True, True]


@pytest.mark.parametrize("name", LANGUAGES)
def test_the_page_says_a_prompt_as_the_server_does(name: str, call: Call) -> None:
    language, script = LANGUAGES[name], "({ promptText }, language, all) => all.map((one) => promptText(language, one))"
    requests = sorted(language.requests)
    asked = [{"movement": request.movement, "focus": request.focus} for request in requests]
    told = call("prompts", script, language_json(name, language), asked)
    assert told == [prompt_text(language, request) for request in requests]


@pytest.mark.parametrize(
    ("count", "left", "old", "told"),
    [
        (3, 9, None, "Demonstration 4 · 9 to go"),
        (12, 0, None, "Demonstration 13 · all were shown, more are welcome"),
        (3, 9, 1, "Redraw demonstration 2"),
        (3, None, None, "Demonstration 4"),
    ],
)
def test_a_demonstration_is_counted(count: int, left: int | None, old: int | None, told: str, call: Call) -> None:
    next_one = {"left": left or 0, "prompt": None if left is None else {"text": "Draw"}}
    session = {"demonstrations": [{}] * count, "next": next_one}
    assert call("prompts", "({ counted }, session, old) => counted(session, old)", session, old) == told


def test_what_is_to_be_drawn_is_said_for_prompts_for_made_up_signs_and_for_redrawing(call: Call) -> None:
    language, request = language_json("paper", LANGUAGES["paper"]), {"movement": 0, "focus": 0}
    session = {"language": language, "demonstrations": [{"prompt": request, "by": "person"}, {"prompt": None}]}
    say = "({ sentence }, session, prompt, old) => sentence(session, prompt, old)"
    assert call("prompts", say, session, {"text": "Draw a circle."}, None) == "Draw a circle."
    assert call("prompts", say, session, None, None).startswith("Make up two signs")
    again = call("prompts", say, session, None, 0)
    assert again.endswith("about the red object; once is enough. Draw again whatever went wrong.")
    assert call("prompts", say, session, None, 1) == "Draw again whatever went wrong."
    shown = call("prompts", "({ shownTexts }, session) => [0, 1].map((n) => shownTexts(session, n))", session)
    assert shown == [["Demonstration 1, by person", again.split(" Draw again")[0]], ["Demonstration 2", ""]]


def test_what_is_suspected_can_be_redrawn_or_kept_where_it_is_doubted(call: Call) -> None:
    script = """
    ({ doubtItem, startBelief }, doubt) => {
      const redrawn = [];
      startBelief({ redraw: (number) => redrawn.push(number) });
      const host = document.createElement("ul");
      host.append(doubtItem(doubt));
      const [redraw, keep] = host.querySelectorAll("button");
      redraw?.click();
      const before = host.firstChild.firstChild.textContent;
      keep?.click();
      return [before, redrawn, host.textContent, doubtItem(doubt).textContent];
    }"""
    doubt = {"number": 4, "text": "It is odd.", "suspected": True}
    kept = "It is odd. It is kept as it is."
    assert call("belief", script, doubt) == ["It is odd. ", [4], kept, kept]
    assert call("belief", script, {**doubt, "suspected": False})[:2] == ["It is odd.", []]


def test_a_belief_is_said_with_its_probability(call: Call) -> None:
    belief = {"labels": [2, 0, -1], "focus": [1, 0, -1], "focus_probability": [[0.029, 0.971], [1, 0], [0.5, 0.5]]}
    belief |= {"names": ["", "", "wave"]}
    say = "({ beliefSentence }, belief) => [0, 1, 2].map((n) => beliefSentence(belief, n))"
    told = ["Movement 3 (wave) about the green object, 97 %", "Movement 1 about the red object, 100 %"]
    assert call("pictures", say, belief) == [*told, "None of the movements that the others show"]


def test_a_ring_is_drawn_about_each_object_as_far_as_it_is_probable(call: Call) -> None:
    shown = {"objects": [[0, 0.1], [0.1, 0], [0.2, 0]], "hand": LINE}
    script = """({ scenePicture }, shown) => [...scenePicture(shown, [0.01, 0.25, 1], "").querySelectorAll(".ring")]
      .map((ring) => [ring.getAttribute("cx"), ring.getAttribute("stroke-dasharray")])"""
    assert call("pictures", script, shown) == [["10", "25.0 100"], ["20", None]]


def test_text_goes_into_the_page_as_text(call: Call) -> None:
    title = "<img src=x onerror=alert(1)>"
    script = '({ make }, text) => make("p", { textContent: text }, text).innerHTML'
    assert "<" not in call("dom", script, title)


def test_counts_shares_and_sentences_are_written_as_people_do(call: Call) -> None:
    script = '(m) => [m.plural(1, "answer"), m.plural(0, "answer"), m.percent(0.256), m.capital("a word")]'
    assert call("dom", script) == ["1 answer", "0 answers", "26 %", "A word"]


def test_what_went_wrong_is_said_until_something_goes_right(call: Call) -> None:
    script = """async ({ attempt, byId }) => {
      const alert = byId("alert");
      const failed = await attempt(() => Promise.reject(new Error("No.")));
      return [failed, alert.hidden, alert.firstElementChild.textContent, await attempt(async () => 7), alert.hidden];
    }"""
    assert call("dom", script) == [None, False, "No.", 7, True]


def test_a_session_that_is_no_newer_than_what_is_known_is_dropped(call: Call) -> None:
    script = "({ accept }, ...sessions) => sessions.map((session) => accept(session).title)"
    sessions = [
        {**_session(), "events": events, "title": title} for events, title in zip((5, 4, 5, 6), "abcd", strict=True)
    ]
    other = {**_session(), "id": "two", "events": 1, "title": "e"}
    assert call("store", script, *sessions, other) == ["a", "a", "a", "d", "e"]


def test_a_change_that_comes_too_late_shows_the_session_as_it_is(call: Call) -> None:
    script = """async (m, old, fresh) => {
      const { Refusal } = await import("./api.js");
      m.store.session = old;
      const fetched = window.fetch;
      window.fetch = async () => new Response(JSON.stringify(fresh));
      const problem = await m.change(() => Promise.reject(new Refusal(409, "stale"))).catch((one) => one.message);
      window.fetch = fetched;
      return [problem, m.store.session.revision];
    }"""
    problem, revision = call("store", script, _session(revision=3), _session(revision=4))
    assert problem.startswith("Somebody changed this session meanwhile.")
    assert revision == 4


def test_the_strokes_of_a_demonstration_are_fetched_once_for_each_revision(call: Call) -> None:
    script = """async (m, first, second) => {
      const fetched = window.fetch;
      const asked = [];
      window.fetch = async (path) => asked.push(path) && new Response("{}");
      m.accept(first);
      await m.demonstration(1);
      await m.demonstration(1);
      m.accept({ ...first, events: first.events + 1 });
      await m.demonstration(1);
      m.accept(second);
      await m.demonstration(1);
      window.fetch = fetched;
      return asked;
    }"""
    asked = call("store", script, {**_session(), "events": 10}, {**_session(revision=4), "events": 12})
    assert asked == ["api/sessions/one/demonstrations/1"] * 2


def test_frames_and_news_of_the_socket_are_told_apart(call: Call) -> None:
    header = {"hand": [0.1, 0.2], "text": "Grün"}
    encoded = json.dumps(header, ensure_ascii=False).encode()
    frame = struct.pack(">I", len(encoded)) + encoded + b"\xff\xd8jpeg"
    script = """({ LiveTable }, bytes, news) => {
      const heard = [];
      const listeners = { frame: (header, jpeg) => heard.push([header, [...jpeg]]), changed: (one) => heard.push(one) };
      const table = Object.assign(Object.create(LiveTable.prototype), { listeners });
      table.heard(new Uint8Array(bytes).buffer);
      for (const one of news) table.heard(JSON.stringify(one));
      return heard;
    }"""
    news = [{"type": "changed", "events": 2}, {"type": "unheard of"}]
    assert call("socket", script, list(frame), news) == [[header, list(b"\xff\xd8jpeg")], news[0]]


TABLE = """
({ AskTable }, header, ...deeds) => {
  const [host, sent, taken] = [document.createElement("div"), [], []];
  document.body.append(host);
  const table = new AskTable(host, { send: (message) => sent.push(message), watch: () => {} }, () => {});
  table.header = header;
  table.stage.metres = ([x, y]) => [x, y];
  for (const [name, ...given] of deeds) taken.push(table[name](...given));
  host.remove();
  return [sent, taken, table.held];
}
"""
HEADER: Json = {"objects": [[0, 0], [0.2, 0]], "hand": [0.05, 0.03], "trail": [], "focus": None}


@pytest.mark.parametrize(
    ("place", "held"),
    [
        ([0.01, 0], {"object": 0, "sent": 0}),
        ([0.21, 0], {"object": 1, "sent": 0}),
        ([0.05, 0.04], {"shove": True, "to": None}),
    ],
)
def test_a_pointer_takes_hold_of_what_is_nearest(place: list[float], held: Json, call: Call) -> None:
    assert call("asktable", TABLE, HEADER, ["begin", place])[1:] == [[True], held]


def test_a_pointer_on_the_bare_table_takes_hold_of_nothing(call: Call) -> None:
    assert call("asktable", TABLE, HEADER, ["begin", [0.5, 0.4]])[1:] == [[False], None]


def test_a_flick_shoves_as_far_as_it_goes_and_no_harder_than_the_arm_bears(call: Call) -> None:
    for to, velocity in (([0.15, 0.03], [0.4, 0]), ([0.05, -0.97], [0, -1])):
        sent = call("asktable", TABLE, HEADER, ["begin", [0.05, 0.03]], ["move", to], ["end"])[0]
        assert [message["type"] for message in sent] == ["shove"]
        np.testing.assert_allclose(sent[0]["velocity"], velocity, atol=1e-9)
    assert call("asktable", TABLE, HEADER, ["begin", [0.05, 0.03]], ["move", [0.051, 0.03]], ["end"])[0] == []


def test_a_dragged_object_is_told_of_now_and_then_and_where_it_is_let_go(call: Call) -> None:
    moves = [["move", [0.01 * i, 0.123456]] for i in range(20)]
    sent, *_ = call("asktable", TABLE, HEADER, ["begin", [0, 0]], *moves, ["end"])
    assert sent[-1] == {"type": "drag", "object": 0, "to": [0.19, 0.1235]}
    assert 2 <= len(sent) < len(moves)
