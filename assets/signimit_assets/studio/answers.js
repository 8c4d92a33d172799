/** The answers of the arm in a list, the latest first, each with what can be done about it. */

import { button, capital, make, percent } from "./dom.js";
import { objectName } from "./store.js";

const MOST = 50; // answers in the list

/**
 * Show the answers of a session.
 * @param {{judge, correct, replay}} listeners `judge` is called with an answer that a person finds wrong, the others with
 *   the number of one
 */
export function answersList({ answers, language }, listeners) {
  const rows = [...answers].reverse().slice(0, MOST).map((answer) => row(answer, language, listeners));
  const judged = answers.filter(({ verdict }) => verdict !== null);
  const good = judged.filter(({ verdict }) => verdict).length;
  const score = judged.length ? `${good} of ${judged.length} judged right (${percent(good / judged.length)})` : "";
  return [
    make("h3", { textContent: "Answers" }),
    make("p", { className: "quiet", textContent: answers.length ? score : "None yet." }),
    make("ul", { className: "answers plain-list" }, ...rows),
  ];
}

function row(answer, language, { judge, correct, replay }) {
  const { number, text, held, verdict, request } = answer;
  const wanted = request && language ? `asked for: ${language.movements[request.movement]} about ${objectName(request.focus)}` : "";
  const waits = held ? "· the arm asked back" : "";
  const said = { true: "· judged right", false: "· judged wrong", null: "" }[String(verdict)];
  const plain = (word, label, done) => button(word, done, { className: "plain", "aria-label": label });
  return make(
    "li",
    {},
    make("span", {}, `${number + 1}. ${capital(text)} ${waits} ${said}`, make("span", { className: "quiet", textContent: wanted })),
    verdict === null ? plain("Wrong", `Answer ${number + 1} is wrong`, () => judge(answer)) : null,
    verdict === false ? plain("Correct", `Correct answer ${number + 1}`, () => correct(number)) : null,
    plain("Replay", `Replay answer ${number + 1}`, () => replay(number)),
  );
}
