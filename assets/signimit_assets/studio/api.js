/** Client of the studio's HTTP API. Addresses are relative: the token is in the page's own. */

/** A request that was refused; `message` is the server's sentence. */
export class Refusal extends Error {
  constructor(status, sentence) {
    super(sentence);
    this.status = status;
  }
}

const AWAY = "The studio does not answer. Is it still running?";

async function refusal(answer) {
  const told = await answer.json().catch(() => ({}));
  return new Refusal(answer.status, told.error ?? `The studio answered with ${answer.status}.`);
}

async function send(path, options) {
  let answer;
  try {
    answer = await fetch(`api/${path}`, options);
  } catch {
    throw new Refusal(0, AWAY);
  }
  if (!answer.ok) throw await refusal(answer);
  return answer;
}

const json = (method, body) => ({ method, headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });

export const get = async (path) => (await send(path)).json();
export const post = async (path, body = {}) => (await send(path, json("POST", body))).json();
export const put = async (path, body) => (await send(path, json("PUT", body))).json();
export const remove = async (path) => (await send(path, { method: "DELETE" })).json();
export const blob = async (path) => (await send(path)).blob();
export const upload = async (path, file) =>
  (await send(path, { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: file })).json();
