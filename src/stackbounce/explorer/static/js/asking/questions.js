/** Questions one at a time: while one waits for its first answer, only the newest of the others is kept. */

/**
 * Return `{ask(...question), drop()}`; after `drop` nobody waits any more. So views follow a slider, each answer whole.
 * @param {(told: (news) => void, ...question) => Promise} answer tells news before its last ones, with an `answer` or without
 * @param {(news: object) => void} tell hears the news of the present question, or its {problem}
 */
export function oneAtATime(answer, tell) {
  let present = 0;
  let free = true; // the present question has an answer, be it a coarse one
  let next = null;
  const begin = async () => {
    const question = next;
    present += 1;
    const mine = present;
    next = null;
    free = false;
    const told = (news) => {
      if (mine !== present) return;
      if (news) tell(news);
      if (news && !news.answer && !news.problem) return;
      free = true;
      if (next) begin();
    };
    try {
      told(await answer(told, ...question));
    } catch (error) {
      told({ problem: error.message });
    }
  };
  const ask = (...question) => {
    next = question;
    if (free) begin();
  };
  const drop = () => {
    present += 1;
    free = true;
    next = null;
  };
  return { ask, drop };
}
