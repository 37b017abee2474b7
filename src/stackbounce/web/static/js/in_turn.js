/** Questions one after the other: so what is drawn follows a slider, one whole answer after the next. */

/**
 * Return `{ask(question), drop()}`. While one question waits for its first answer, only the newest of the others is kept.
 * @param {(question, heard) => Promise} answer calls `heard` with news; those with an `answer` are what is waited for
 * @param {(news) => void} tell hears the news, or {problem}, of all that was not dropped
 */
export function inTurn(answer, tell) {
  let newest = 0;
  let dropped = 0; // the last question that nobody waits for any more
  let next = null;
  let free = true;

  const start = async () => {
    const one = next;
    next = null;
    free = !one;
    if (free) return;
    let waits = true;
    const seen = () => {
      if (waits) start();
      waits = false;
    };
    const heard = (news) => {
      if (one.mine > dropped) tell(news);
      if (news.answer) seen();
    };
    try {
      await answer(one.question, heard);
    } catch (error) {
      if (one.mine === newest && one.mine > dropped) tell({ problem: error.message });
    }
    seen();
  };
  const ask = (question) => {
    newest += 1;
    next = { mine: newest, question };
    if (free) start();
  };
  const drop = () => {
    dropped = newest;
    next = null;
  };
  return { ask, drop };
}
