/** x */
export const table = {};
