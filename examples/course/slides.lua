-- slides.lua - turns a course in Markdown into articles of a page or, with `-M deck`, into slides.
-- A heading of level 2 begins a slide.  Below it stand a picture, paragraphs, equations in $$ $$, a list
-- of addresses of the playground, C lines with their values, and questions in <details>.
local deck, live, count = false, false, 0
local LONGEST = 150         -- characters of text beside a picture
local LONGER = 330          -- and on a slide of words

local function html(text) return pandoc.RawBlock('html', text) end
local function escaped(text) return (text:gsub('&', '&amp;'):gsub('<', '&lt;'):gsub('"', '&quot;')) end
local function address(target) return (target:gsub('^%.%./playground/index%.html#', 'index.html#turn=0&')) end
local function bare(target) return (target:gsub('#', '#bare&')) end

local function is_equation(block)
    return block.t == 'Para' and #block.content == 1 and block.content[1].t == 'Math' and
        block.content[1].mathtype == 'DisplayMath'
end
local function picture_of(block)
    return block.t == 'Para' and #block.content == 1 and block.content[1].t == 'Image' and block.content[1]
end

-- C lines: code // = value
local function code_lines(text)
    local lines = pandoc.List()
    for line in text:gmatch('[^\n]+') do
        local code, value = line:match('^(.-) // = (.*)$')
        lines:insert(html('<pre><code>' .. escaped(code or line) .. '</code>' ..
            (value and ' <b>= ' .. value .. '</b>' or '') .. '</pre>'))
    end
    return lines
end

-- Cuts paragraphs after sentences: pieces of at most `first` characters, then `rest`.
local function pieces(paragraphs, first, rest)
    local all, piece, sentence = pandoc.List(), pandoc.List(), pandoc.List()
    local function length(inlines) return utf8.len(pandoc.utils.stringify(pandoc.Para(inlines))) end
    local function add()
        local most = #all == 0 and first or rest
        if #piece > 0 and length(piece) + length(sentence) > most then
            all:insert(piece)
            piece = pandoc.List()
        end
        piece:extend(sentence)
        sentence = pandoc.List()
    end
    for _, block in ipairs(paragraphs) do
        for _, inline in ipairs(block.content) do
            sentence:insert(inline)
            if inline.t == 'Str' and (inline.text:match('[^%d][.?]$') or inline.text:match('^[.?]$')) then
                add()
            end
        end
        sentence:insert(pandoc.Space())
        add()
    end
    if #piece > 0 then all:insert(piece) end
    return all
end

local function parts_of(blocks)
    local slide = { text = pandoc.List(), equations = pandoc.List(), code = pandoc.List(),
                    links = pandoc.List(), questions = pandoc.List() }
    local asking
    for _, block in ipairs(blocks) do
        if block.t == 'RawBlock' then
            if block.text:match('^<details>') then
                asking = { question = pandoc.List(), answer = pandoc.List() }
                asking.to = asking.question
                slide.questions:insert(asking)
            elseif block.text:match('^</summary>') then asking.to = asking.answer
            elseif block.text:match('^</details>') then asking = nil end
        elseif asking then asking.to:insert(block)
        elseif picture_of(block) then slide.picture = picture_of(block)
        elseif is_equation(block) then slide.equations:insert(block)
        elseif block.t == 'CodeBlock' then slide.code:extend(code_lines(block.text))
        elseif block.t == 'BulletList' then
            for _, item in ipairs(block.content) do slide.links:insert(item[1].content[1]) end
        else slide.text:insert(block) end
    end
    return slide
end

local function file_of(image) return (image.src:gsub('^%.%./', '')) end
local function alt_of(image) return escaped(pandoc.utils.stringify(image.caption)) end

local function article(heading, slide)
    local out = pandoc.List{ html('<article id="' .. count .. '"><h2><a href="#' .. count .. '">'),
        pandoc.Plain(heading), html('</a></h2>') }
    if slide.picture then
        local file = file_of(slide.picture)
        out:insert(html('<a class="picture" href="' .. file .. '"><img src="' .. file .. '" alt="' ..
            alt_of(slide.picture) .. '" loading="lazy"></a>'))
    end
    out:insert(html('<div class="words">'))
    out:extend(slide.text)
    for _, equation in ipairs(slide.equations) do
        out:extend{ html('<div class="equation">'), equation, html('</div>') }
    end
    for _, link in ipairs(slide.links) do
        out:extend{ html('<p class="play"><a href="' .. escaped(address(link.target)) .. '">'),
            pandoc.Plain(link.content), html('</a></p>') }
    end
    out:extend(slide.code)
    for _, ask in ipairs(slide.questions) do
        out:insert(html('<details><summary>'))
        for _, block in ipairs(ask.question) do out:insert(pandoc.Plain(block.content)) end
        out:insert(html('</summary>'))
        out:extend(ask.answer)
        out:insert(html('</details>'))
    end
    out:insert(html('</div></article>'))
    return out
end

-- The picture, and over it the playground: it lives in a frame named so that links reach it.
local function figure(slide)
    local out = pandoc.List{ html('<figure>') }
    local image, link = slide.picture, slide.links[1]
    local name = 'live-' .. count
    out:insert(html('<div class="view"><img src="' .. file_of(image) .. '" alt="' .. alt_of(image) .. '">'))
    if live and link then
        out:insert(html('<iframe name="' .. name .. '" title="' .. alt_of(image) .. '" tabindex="-1" data-src="' ..
            escaped(bare(address(link.target))) .. '"></iframe>'))
    end
    out:insert(html('</div></figure>'))
    return out, name
end

local function sections(heading, slide)
    local out = pandoc.List()
    local function open(class) out:extend{ html('<section class="' .. class .. '"><h2>'),
        pandoc.Plain(heading), html('</h2>') } end
    local text = pieces(slide.text, LONGEST, LONGER)
    open(slide.picture and 'both' or 'words')
    out:insert(html('<div class="columns">'))
    local name
    if slide.picture then
        local shown
        shown, name = figure(slide)
        out:extend(shown)
    end
    out:insert(html('<div class="statement">'))
    if text[1] then out:insert(pandoc.Para(text[1])) end
    out:insert(html('</div></div>'))
    out:extend(slide.equations)
    out:insert(html('<aside class="notes">'))
    for _, ask in ipairs(slide.questions) do
        out:extend(ask.question)
        out:extend(ask.answer)
    end
    out:extend(slide.code)
    out:insert(html('</aside></section>'))
    if #slide.links > 0 and slide.picture and live then
        open('try')
        out:insert(html('<div class="columns">'))
        local shown, frame = figure(slide)
        frame = frame .. '-b'
        for _, block in ipairs(shown) do
            if block.text then block.text = block.text:gsub('name="live%-%d+"', 'name="' .. frame .. '"') end
        end
        out:extend(shown)
        out:insert(html('<ul class="play">'))
        for _, link in ipairs(slide.links) do
            out:extend{ html('<li><a target="' .. frame .. '" href="' ..
                escaped(bare(address(link.target))) .. '">'), pandoc.Plain(link.content), html('</a></li>') }
        end
        out:insert(html('</ul></div></section>'))
    end
    for i = 2, #text do
        open('words')
        out:extend{ pandoc.Para(text[i]), html('</section>') }
    end
    for _, ask in ipairs(slide.questions) do
        open('ask')
        out:insert(html('<div class="question">'))
        out:extend(ask.question)
        out:insert(html('</div><div class="fragment answer">'))
        out:extend(ask.answer)
        out:insert(html('</div></section>'))
    end
    return out
end

function Pandoc(doc)
    deck, live = doc.meta.deck ~= nil, doc.meta.live ~= nil
    local out, about, heading, body = pandoc.List(), pandoc.List(), nil, pandoc.List()
    local contents = pandoc.List()
    local function finish()
        if not heading then about:extend(body)
        else
            count = count + 1
            out:extend((deck and sections or article)(heading, parts_of(body)))
            contents:insert({ pandoc.Plain{ pandoc.Link(heading, '#' .. count) } })
        end
        body = pandoc.List()
    end
    for _, block in ipairs(doc.blocks) do
        if block.t == 'Header' and block.level == 2 then
            finish()
            heading = block.content
        else body:insert(block) end
    end
    finish()
    doc.meta.about = pandoc.MetaBlocks(about)
    doc.meta.slides = pandoc.MetaBlocks{ pandoc.OrderedList(contents) }
    doc.blocks = out
    return doc
end
